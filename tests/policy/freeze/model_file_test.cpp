#include "policy/freeze/model_file.hpp"

#include <gtest/gtest.h>

#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;

TEST(ModelFile, IsForeignByItsBytesOrItsName) {
  EXPECT_TRUE(is_foreign_model("PK\x03\x04", "a.bin")) << "a zip archive, whatever it is called";
  EXPECT_TRUE(is_foreign_model("anything", "a.onnx"));
  EXPECT_TRUE(is_foreign_model("anything", "a.zip")) << "so that a damaged archive is called one";
  EXPECT_FALSE(is_foreign_model("{\"format\"", "a.checkpoint"));
  EXPECT_FALSE(is_foreign_model("P", "onnx"));
}

TEST(ModelFile, IsReadAsWhatItIs) {
  EXPECT_EQ(read_model(test::model("memory.zip"), "a.bin").layers.size(), 3U);
  EXPECT_EQ(read_model(test::model("memory.onnx"), "a.onnx").layers.size(), 3U);
  EXPECT_NE(refusal([] { (void)read_model("swordfish", "a.zip"); }).find("a.zip: not a zip archive"), std::string::npos);
  EXPECT_NE(refusal([] { (void)read_model("", "a.onnx"); }).find("a.onnx: not an ONNX model"), std::string::npos);
}

TEST(ModelFile, IsSpokenOfInOneLineOfPrintableCharacters) {
  EXPECT_EQ(printable("plain ~ text"), "plain ~ text");
  EXPECT_EQ(printable("a\nb\x1f\x7f\xff"), "a?b???");
  EXPECT_EQ(printable(std::string(300, 'x')).size(), 300U);
  EXPECT_EQ(printable(std::string(10'000, 'x')).size(), 300U);
}

}  // namespace
}  // namespace earshot::freeze
