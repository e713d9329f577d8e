#include "policy/freeze/onnx/onnx_tensor.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/policy/freeze/bytes.hpp"
#include "tests/policy/freeze/onnx/onnx_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using test::external_tensor;
using test::field;
using test::refusal;
using namespace std::string_literals;
namespace fs = std::filesystem;

/// A model's folder, with the numbers 1 to 8 in a file "w.data".
class OnnxTensorFiles : public testing::Test {
 protected:
  OnnxTensorFiles() { write("w.data", test::bytes_of({1, 2, 3, 4, 5, 6, 7, 8})); }

  void write(const fs::path& name, const std::string& content) const { std::ofstream(folder() / name, std::ios::binary) << content; }
  [[nodiscard]] fs::path folder() const { return outer_.path() / "model"; }
  [[nodiscard]] fs::path outside() const { return outer_.path(); }
  [[nodiscard]] OnnxTensor read(std::initializer_list<std::pair<std::string, std::string>> entries) const {
    return OnnxTensorReader(folder()).read(external_tensor("w", {2, 3}, entries));
  }
  [[nodiscard]] std::string refused(std::initializer_list<std::pair<std::string, std::string>> entries) const {
    return refusal([&] { (void)read(entries); });
  }
  void expect_refused(std::initializer_list<std::pair<std::string, std::string>> entries, const std::string& why) const {
    const std::string said = refused(entries);
    EXPECT_EQ(said.find("initializer w: "), 0U) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
  }

 private:
  struct Outer : support::TemporaryFolder {
    Outer() { fs::create_directory(path() / "model"); }
  } outer_;
};

TEST_F(OnnxTensorFiles, HoldTheWeightsFromTheOffsetOn) {
  EXPECT_EQ(read({{"location", "w.data"}, {"offset", "8"}, {"length", "24"}}).values, (std::vector<float>{3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(read({{"length", "24"}, {"location", "./w.data"}}).values, (std::vector<float>{1, 2, 3, 4, 5, 6})) << "offset 0 where none is";
  EXPECT_EQ(read({{"location", "w.data"}, {"offset", "8"}}).values, (std::vector<float>{3, 4, 5, 6, 7, 8})) << "what is left of the file";
  EXPECT_EQ(read({{"location", "w.data"}, {"offset", "8"}, {"checksum", "0a"}}).values.size(), 6U);
  fs::create_directory(folder() / "deeper");
  write("deeper/w.data", test::bytes_of({6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(read({{"location", "deeper/w.data"}}).values, (std::vector<float>{6, 5, 4, 3, 2, 1}));
}

TEST_F(OnnxTensorFiles, AreNamedOnceEachInTheOrderOfTheTensors) {
  write("v.data", test::bytes_of({1, 2}));
  OnnxTensorReader reader(folder());
  EXPECT_EQ(reader.read(external_tensor("v", {2}, {{"location", "v.data"}})).values, (std::vector<float>{1, 2}));
  (void)reader.read(test::tensor("inside", {1}, {1}));
  (void)reader.read(external_tensor("w", {2}, {{"location", "w.data"}, {"length", "8"}}));
  (void)reader.read(external_tensor("x", {2}, {{"location", "v.data"}}));
  EXPECT_EQ(reader.data_files(), (std::vector<fs::path>{folder() / "v.data", folder() / "w.data"}));
}

TEST_F(OnnxTensorFiles, AreRefusedOutsideOfTheModelsFolder) {
  std::ofstream(outside() / "secret", std::ios::binary) << test::bytes_of({1, 2, 3, 4, 5, 6});
  for (const std::string& location : {(folder() / "w.data").string(), "../secret"s, "deeper/../w.data"s, "w.data\0"s, ".."s}) {
    expect_refused({{"location", location}, {"length", "24"}}, "must be a file in the model's folder");
  }
  fs::create_symlink("../secret", folder() / "link.data");
  expect_refused({{"location", "link.data"}}, "location = \"link.data\": must be a file in the model's folder");
  fs::create_directory_symlink(outside(), folder() / "out");
  expect_refused({{"location", "out/secret"}}, "must be a file in the model's folder");
  fs::create_symlink("w.data", folder() / "near.data");
  EXPECT_EQ(read({{"location", "near.data"}, {"length", "24"}}).values.size(), 6U) << "a link that stays in the folder";
}

TEST_F(OnnxTensorFiles, AreRefusedWhenTheyAreNoRegularFiles) {
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  expect_refused({{"location", "pipe"}}, "only regular files are read");
  expect_refused({{"location", "."}}, "it is a folder");
}

TEST_F(OnnxTensorFiles, AreAskedForByNameWhereTheyAreMissing) {
  expect_refused({{"location", "external.onnx.data"}},
                 "its weights are in external.onnx.data, which is not beside the model: put it there");
  expect_refused({{"location", "external.onnx.data"}}, "external_data=False");
}

TEST_F(OnnxTensorFiles, AreNotReadBeyondTheirEnd) {
  expect_refused({{"location", "w.data"}, {"offset", "12"}, {"length", "24"}},
                 "offset = 12, length = 24: extends beyond the 32 bytes of w.data");
  expect_refused({{"location", "w.data"}, {"offset", "33"}}, "extends beyond the 32 bytes");
  expect_refused({{"location", "w.data"}, {"offset", "18446744073709551608"}, {"length", "24"}}, "extends beyond");  // their sum is 16
  expect_refused({{"location", "w.data"}, {"offset", "8"}, {"length", "18446744073709551615"}}, "extends beyond");
}

TEST_F(OnnxTensorFiles, AreRefusedWhereTheirEntriesAreNotAsTheyMustBe) {
  expect_refused({{"location", "w.data"}, {"length", "20"}}, "length = 20: not as many numbers as its shape states");
  expect_refused({{"location", "w.data"}, {"length", "32"}}, "length = 32: not as many numbers as its shape states");
  expect_refused({{"location", "w.data"}}, "length = 32: not as many");
  expect_refused({{"offset", "8"}}, "location: is missing");
  expect_refused({{"location", ""}}, "location: is missing");
  expect_refused({{"location", "w.data"}, {"location", "w.data"}}, "location: given twice");
  expect_refused({{"location", "w.data"}, {"prepacked_0", "x"}}, "prepacked_0 is unknown");
  for (const std::string number : {"", "-8", "8x", "0x8", " 8", "99999999999999999999"}) {
    expect_refused({{"location", "w.data"}, {"offset", number}}, "offset = \"" + number + "\": must be a number of bytes");
    expect_refused({{"location", "w.data"}, {"length", number}}, "length = \"" + number + "\": must be a number of bytes");
  }
}

TEST_F(OnnxTensorFiles, AreRefusedBesideValuesInTheModelAndWithoutAWordOfThem) {
  const std::string external = external_tensor("w", {2, 3}, {{"location", "w.data"}, {"length", "24"}});
  const auto refused_bytes = [&](const std::string& bytes) { return refusal([&] { (void)OnnxTensorReader(folder()).read(bytes); }); };
  EXPECT_EQ(refused_bytes(external), "");
  EXPECT_NE(refused_bytes(external + field(9, test::bytes_of({1}))).find("its values stand in more than one place"), std::string::npos);
  EXPECT_TRUE(support::has_line(refused_bytes(external + field(14, 0)), {"data_location", "external_data", "not"}));
  EXPECT_NE(refused_bytes(external + field(14, 2)).find("data_location = 2: is unknown"), std::string::npos);
  EXPECT_NE(refused_bytes(test::tensor("w", {1}, {1}) + field(14, 1)).find("do not fit each other"), std::string::npos);
}

/// A model may name one file for any number of tensors.
TEST_F(OnnxTensorFiles, AreNotReadTimeAndAgain) {
  write("large.data", std::string(std::size_t{2} << 20U, '\0'));
  OnnxTensorReader reader(folder());
  const std::string half = external_tensor("h", {512, 1024}, {{"location", "large.data"}});
  EXPECT_EQ(reader.read(half).values.size(), 512U * 1024U);
  EXPECT_EQ(reader.read(half).values.size(), 512U * 1024U);
  EXPECT_NE(refusal([&] { (void)reader.read(half); }).find("more weights than any policy that flies"), std::string::npos);
}

TEST(OnnxTensor, TakesItsValuesFromOnePlaceInTheModel) {
  const std::string head = field(1, 2) + field(2, 1) + field(8, "w"s);
  const std::string one = test::bytes_of({1});
  EXPECT_EQ(OnnxTensorReader("").read(head + field(4, one + one)).values, (std::vector<float>{1, 1}));
  EXPECT_EQ(OnnxTensorReader("").read(head + field(9, ""s) + field(4, one + one)).values, (std::vector<float>{1, 1}));
  EXPECT_EQ(OnnxTensorReader("").read(head + test::real_field(4, 1) + test::real_field(4, 2)).values, (std::vector<float>{1, 2}));
  EXPECT_NE(refusal([&] { (void)OnnxTensorReader("").read(head + field(4, one) + field(9, one)); }).find("more than one place"),
            std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
