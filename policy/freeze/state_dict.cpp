#include "policy/freeze/state_dict.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/pickle.hpp"
#include "policy/freeze/zip_archive.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using Kind = PickleValue::Kind;

constexpr std::string_view kRebuildTensor = "torch._utils._rebuild_tensor_v2";
constexpr std::string_view kFloatStorage = "torch.FloatStorage";
constexpr std::string_view kPickleName = "/data.pkl";
constexpr std::size_t kMaxValues = std::size_t{1024} * 1024;  ///< of all tensors; far more than the networks that fly

const PickleRules& rules() {
  static const PickleRules kRules{
      .may_name = [](std::string_view name) { return name == kOrderedDict || name == kRebuildTensor || name == kFloatStorage; },
      .may_call = [](std::string_view name) { return name == kOrderedDict || name == kRebuildTensor; }};
  return kRules;
}

std::size_t natural(const PickleValue& value) {
  if (value.kind != Kind::kInteger || value.integer < 0) throw BadInput("expected a number that is not negative");
  return static_cast<std::size_t>(value.integer);
}

std::vector<std::size_t> naturals(const Pickle& pickle, const PickleValue& tuple) {
  if (tuple.kind != Kind::kTuple) throw BadInput("expected a tuple of numbers");
  std::vector<std::size_t> numbers;
  for (const std::size_t place : tuple.items) numbers.push_back(natural(pickle.at(place)));
  return numbers;
}

/// How many values a shape holds.
std::size_t size_of(const std::vector<std::size_t>& shape) {
  std::size_t size = 1;
  for (const std::size_t side : shape) {
    if (side == 0 || side > kMaxValues / size) throw BadInput("of a size that cannot be");
    size *= side;
  }
  return size;
}

void check_contiguous(const std::vector<std::size_t>& shape, const std::vector<std::size_t>& strides) {
  std::size_t expected = 1;
  bool contiguous = shape.size() == strides.size();
  for (std::size_t i = shape.size(); contiguous && i-- > 0;) {
    contiguous = shape[i] == 1 || strides[i] == expected;
    expected *= shape[i];
  }
  if (!contiguous) throw BadInput("not stored row by row");
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : archive_(bytes) {
    const std::string pickle_name = archive_.name_ending_in(kPickleName);
    folder_ = pickle_name.substr(0, pickle_name.size() - kPickleName.size());
    if (archive_.has(folder_ + "/byteorder") && archive_.read(folder_ + "/byteorder") != "little") throw BadInput("not little-endian");
    pickle_ = read_pickle(archive_.read(pickle_name), rules());
  }

  StateDict read() {
    const PickleValue& top = pickle_.top();
    if (top.kind != Kind::kDictionary) throw BadInput("pickle: not a state_dict");
    StateDict tensors;
    for (std::size_t i = 0; i + 1 < top.items.size(); i += 2) {
      const PickleValue& name = pickle_.at(top.items[i]);
      if (name.kind != Kind::kText) throw BadInput("pickle: a tensor's name is not a text");
      try {
        if (!tensors.emplace(name.text, tensor(pickle_.at(top.items[i + 1]))).second) throw BadInput("given twice");
      } catch (const BadInput& e) {
        throw BadInput("tensor " + name.text + ": " + e.what());
      }
    }
    return tensors;
  }

 private:
  /// _rebuild_tensor_v2(storage, storage_offset, size, stride, requires_grad, backward_hooks)
  Tensor tensor(const PickleValue& call) {
    if (call.kind != Kind::kCall || call.text != kRebuildTensor || call.items.size() != 6) throw BadInput("not a plain tensor");
    const std::string storage = storage_of(pickle_.at(call.items[0]));
    const std::size_t offset = natural(pickle_.at(call.items[1]));
    Tensor tensor{.shape = naturals(pickle_, pickle_.at(call.items[2])), .values = {}};
    check_contiguous(tensor.shape, naturals(pickle_, pickle_.at(call.items[3])));
    const std::size_t size = size_of(tensor.shape);
    const std::size_t stored = storage.size() / sizeof(float);
    if (offset > stored || size > stored - offset) throw BadInput("extends beyond its storage");
    tensor.values.resize(size);
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(tensor.values.data(), storage.data() + offset * sizeof(float), size * sizeof(float));
    return tensor;
  }

  /// ("storage", FloatStorage, key, device, number of values)
  std::string storage_of(const PickleValue& persistent) {
    const PickleValue& tuple = persistent.kind == Kind::kPersistent ? pickle_.at(persistent.items[0]) : persistent;
    if (persistent.kind != Kind::kPersistent || tuple.kind != Kind::kTuple || tuple.items.size() != 5) throw BadInput("has no storage");
    const PickleValue& word = pickle_.at(tuple.items[0]);
    const PickleValue& type = pickle_.at(tuple.items[1]);
    const PickleValue& key = pickle_.at(tuple.items[2]);
    if (word.kind != Kind::kText || word.text != "storage" || key.kind != Kind::kText) throw BadInput("has no storage");
    if (type.kind != Kind::kGlobal || type.text != kFloatStorage) throw BadInput("not float32");
    const std::size_t count = natural(pickle_.at(tuple.items[4]));
    if (count > values_left_) throw BadInput("more weights than any policy that flies");
    values_left_ -= count;
    std::string bytes = archive_.read(folder_ + "/data/" + key.text);
    if (bytes.size() != count * sizeof(float)) throw BadInput("its storage is not of the size it should be");
    return bytes;
  }

  ZipArchive archive_;
  std::string folder_;
  Pickle pickle_;
  std::size_t values_left_ = kMaxValues;
};

}  // namespace

StateDict read_state_dict(std::string_view bytes) {
  return Reader(bytes).read();
}

}  // namespace earshot::freeze
