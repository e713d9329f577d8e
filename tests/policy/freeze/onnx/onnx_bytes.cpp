#include "tests/policy/freeze/onnx/onnx_bytes.hpp"

namespace earshot::freeze::test {

std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 0x7F; value >>= 7U) bytes.push_back(static_cast<char>((value & 0x7FU) | 0x80U));
  bytes.push_back(static_cast<char>(value));
  return bytes;
}

std::string field(unsigned number, const std::string& content) {
  return varint(number << 3U | 2U) + varint(content.size()) + content;
}

std::string field(unsigned number, std::uint64_t value) {
  return varint(number << 3U) + varint(value);
}

std::string real_field(unsigned number, float value) {
  return varint(number << 3U | 5U) + std::string(reinterpret_cast<const char*>(&value), 4);
}

std::string bytes_of(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), 4 * values.size()};
}

std::string tensor(const std::string& name, std::initializer_list<std::uint64_t> shape, const std::vector<float>& values,
                   std::uint64_t type) {
  std::string bytes;
  for (const std::uint64_t side : shape) bytes += field(1, side);
  return bytes + field(2, type) + field(8, name) + field(9, bytes_of(values));
}

std::string external_tensor(const std::string& name, std::initializer_list<std::uint64_t> shape,
                            std::initializer_list<std::pair<std::string, std::string>> entries) {
  std::string bytes;
  for (const std::uint64_t side : shape) bytes += field(1, side);
  bytes += field(2, 1) + field(8, name) + field(14, 1);
  for (const auto& [key, value] : entries) bytes += field(13, field(1, key) + field(2, value));
  return bytes;
}

std::string node(const std::string& operation, std::initializer_list<std::string> inputs, const std::string& output,
                 const std::string& attributes) {
  std::string bytes;
  for (const std::string& input : inputs) bytes += field(1, input);
  return field(1, bytes + field(2, output) + field(4, operation) + attributes);
}

std::string integer_attribute(const std::string& name, std::uint64_t value) {
  return field(5, field(1, name) + field(3, value));
}

std::string real_attribute(const std::string& name, float value) {
  return field(5, field(1, name) + real_field(2, value));
}

}  // namespace earshot::freeze::test
