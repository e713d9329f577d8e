#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

// Messages of onnx.proto3, written by hand.

namespace earshot::freeze::test {

[[nodiscard]] std::string varint(std::uint64_t value);
/// Field `number` of a message.
[[nodiscard]] std::string field(unsigned number, const std::string& content);
[[nodiscard]] std::string field(unsigned number, std::uint64_t value);
[[nodiscard]] std::string real_field(unsigned number, float value);

/// TensorProto with raw_data.
[[nodiscard]] std::string tensor(const std::string& name, std::initializer_list<std::uint64_t> shape, const std::vector<float>& values,
                                 std::uint64_t type = 1);
/// TensorProto whose values are in a file. @param entries  of external_data
[[nodiscard]] std::string external_tensor(const std::string& name, std::initializer_list<std::uint64_t> shape,
                                          std::initializer_list<std::pair<std::string, std::string>> entries);
[[nodiscard]] std::string bytes_of(const std::vector<float>& values);

/// An operator of a graph: field 1 of GraphProto. @param attributes  its field 5, one after another
[[nodiscard]] std::string node(const std::string& operation, std::initializer_list<std::string> inputs, const std::string& output,
                               const std::string& attributes = "");
[[nodiscard]] std::string integer_attribute(const std::string& name, std::uint64_t value);
[[nodiscard]] std::string real_attribute(const std::string& name, float value);

}  // namespace earshot::freeze::test
