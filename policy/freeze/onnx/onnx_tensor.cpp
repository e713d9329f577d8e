#include "policy/freeze/onnx/onnx_tensor.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <set>
#include <span>
#include <system_error>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/onnx/protobuf.hpp"

// Field numbers are those of onnx.proto3 (ONNX 1.17), the schema of every version up to it.

namespace earshot::freeze {
namespace {

using host::BadInput;
using Wire = ProtobufReader::Wire;
using Field = ProtobufReader::Field;

constexpr std::uint64_t kFloat = 1;     // TensorProto.FLOAT
constexpr std::uint64_t kExternal = 1;  // TensorProto.DataLocation.EXTERNAL
constexpr std::uint64_t kMaxSide = 1U << 16U;

void append_floats(std::string_view bytes, std::vector<float>& values) {
  static_assert(std::endian::native == std::endian::little);
  if (bytes.size() % sizeof(float) != 0) throw BadInput("half a number at the end of its data");
  const std::size_t before = values.size();
  values.resize(before + bytes.size() / sizeof(float));
  if (!bytes.empty()) std::memcpy(values.data() + before, bytes.data(), bytes.size());
}

void read_dims(const Field& field, std::vector<std::uint64_t>& shape) {
  if (field.wire == Wire::kVarint) return shape.push_back(field.value);
  for (ProtobufReader packed(field.bytes); !packed.at_end();) shape.push_back(packed.varint());
}

std::uint64_t size_of(const std::vector<std::uint64_t>& shape) {
  std::uint64_t size = 1;
  for (const std::uint64_t side : shape) {
    if (side == 0 || side > kMaxSide || size > kMaxSide * kMaxSide) throw BadInput("of a size that cannot be");
    size *= side;
  }
  return size;
}

/// A tensor, and where its values are if not in it.
struct Described {
  OnnxTensor tensor;
  std::uint64_t type = 0;
  bool is_external = false;
  std::vector<std::string_view> entries;  ///< of external_data
  std::set<std::uint32_t> value_fields;   ///< float_data, raw_data
};

void take(const Field& field, Described& described) {
  switch (field.number) {
    case 1:
      return read_dims(field, described.tensor.shape);
    case 2:
      described.type = field.value;
      return;
    case 4:  // float_data
    case 9:  // raw_data
      if (field.bytes.empty()) return;
      described.value_fields.insert(field.number);
      return append_floats(field.bytes, described.tensor.values);
    case 8:
      described.tensor.name = text_of(field);
      return;
    case 12:  // doc_string
    case 16:  // metadata_props
      return;
    case 13:  // external_data
      described.entries.push_back(field.bytes);
      return;
    case 14:  // data_location
      if (field.value > kExternal) throw BadInput("data_location = " + std::to_string(field.value) + ": is unknown");
      described.is_external = field.value == kExternal;
      return;
    default:
      throw BadInput("field " + std::to_string(field.number) + " is not one that plain float32 weights need");
  }
}

/// Where a tensor's bytes are: the value of each key of external_data.
struct Place {
  std::string location;
  std::uint64_t offset = 0;
  std::optional<std::uint64_t> length;  ///< without it all that is left of the file
};

std::uint64_t natural(const std::string& key, const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) throw BadInput(key + " = \"" + text + "\": must be a number of bytes");
  return number;
}

Place place_of(const std::vector<std::string_view>& entries) {
  Place place;
  std::set<std::string> keys;
  for (const std::string_view entry : entries) {
    const auto [key, value] = text_pair_of(entry);
    if (!keys.insert(key).second) throw BadInput(key + ": given twice");
    if (key == "location") {
      place.location = value;
    } else if (key == "offset") {
      place.offset = natural(key, value);
    } else if (key == "length") {
      place.length = natural(key, value);
    } else if (key != "checksum") {
      throw BadInput("external_data: " + key + " is unknown");
    }
  }
  if (place.location.empty()) throw BadInput("external_data: location: is missing");
  return place;
}

bool leads_out(const std::filesystem::path& path) {
  return path.is_absolute() || std::ranges::find(path, "..") != path.end();
}

/// The file that a location names.
std::filesystem::path file_at(const std::filesystem::path& folder, const std::string& location) {
  const std::string outside = "location = \"" + location + "\": must be a file in the model's folder, by its path from there";
  if (location.find('\0') != std::string::npos || leads_out(location)) throw BadInput(outside);
  const std::filesystem::path beside = folder.empty() ? std::filesystem::path(".") : folder;
  std::error_code error;
  if (!std::filesystem::exists(beside / location, error)) {
    throw BadInput("its weights are in " + location +
                   ", which is not beside the model: put it there, or write the model in one file (torch.onnx.export with "
                   "external_data=False)");
  }
  const std::filesystem::path relative =
      std::filesystem::canonical(beside / location).lexically_relative(std::filesystem::canonical(beside));
  if (relative.empty() || leads_out(relative)) throw BadInput(outside);
  return beside / location;
}

}  // namespace

void OnnxTensorReader::fill_from_file(const std::vector<std::string_view>& entries, OnnxTensor& tensor) {
  const Place place = place_of(entries);
  host::InputFile file(file_at(folder_, place.location), {"a file of weights", host::kModelFile.most_bytes});
  const std::uint64_t rest = place.offset <= file.size() ? file.size() - place.offset : 0;
  const std::uint64_t length = place.length.value_or(rest);
  if (place.offset > file.size() || length > rest) {
    throw BadInput("offset = " + std::to_string(place.offset) + ", length = " + std::to_string(length) + ": extends beyond the " +
                   std::to_string(file.size()) + " bytes of " + place.location);
  }
  const std::uint64_t size = size_of(tensor.shape);
  if (length != size * sizeof(float)) {
    throw BadInput("length = " + std::to_string(length) + ": not as many numbers as its shape states, 4 bytes each");
  }
  if (size > values_left_) throw BadInput("more weights than any policy that flies");
  values_left_ -= size;
  std::string bytes(static_cast<std::size_t>(length), '\0');
  file.go_to(place.offset);
  if (file.read(std::span(reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size())) != bytes.size()) {
    throw BadInput(place.location + ": has become shorter while it was read");
  }
  append_floats(bytes, tensor.values);
  if (std::ranges::find(data_files_, file.path()) == data_files_.end()) data_files_.push_back(file.path());
}

OnnxTensor OnnxTensorReader::read(std::string_view bytes) {
  Described described;
  OnnxTensor& tensor = described.tensor;
  try {
    for (ProtobufReader reader(bytes); const auto field = reader.next();) take(*field, described);
    if (described.type != kFloat) throw BadInput("not float32: export the policy with float32 weights (policy.float())");
    if (described.is_external == described.entries.empty()) throw BadInput("data_location and external_data do not fit each other");
    if (described.value_fields.size() + (described.is_external ? 1U : 0U) > 1U) throw BadInput("its values stand in more than one place");
    const std::uint64_t size = size_of(tensor.shape);
    if (described.is_external) fill_from_file(described.entries, tensor);
    if (tensor.values.size() != size) throw BadInput("not as many numbers as its shape states");
  } catch (const BadInput& e) {
    throw BadInput("initializer " + tensor.name + ": " + e.what());
  }
  return std::move(tensor);
}

}  // namespace earshot::freeze
