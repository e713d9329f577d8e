#include "policy/freeze/onnx/protobuf.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;
using namespace std::string_literals;

void read_all(const std::string& bytes) {
  ProtobufReader reader(bytes);
  while (reader.next()) {
  }
}

// Examples of protobuf.dev, "Encoding": field 1 = 150; field 2 = "testing".
TEST(Protobuf, ReadsTheExamplesOfItsDocumentation) {
  const std::string bytes = "\x08\x96\x01\x12\x07testing"s;
  ProtobufReader reader(bytes);
  const auto number = reader.next();
  ASSERT_TRUE(number);
  EXPECT_EQ(number->number, 1U);
  EXPECT_EQ(number->value, 150U);
  const auto text = reader.next();
  ASSERT_TRUE(text);
  EXPECT_EQ(text->number, 2U);
  EXPECT_EQ(text->bytes, "testing");
  EXPECT_FALSE(reader.next());
}

TEST(Protobuf, ReadsFixedNumbersLittleEndian) {
  const std::string bytes = "\x0d\x00\x00\x80\x3f"s;  // field 1, fixed32, the bits of 1.0F
  ProtobufReader reader(bytes);
  EXPECT_EQ(reader.next()->value, 0x3f80'0000U);
}

TEST(Protobuf, ReadsNumbersOfEightBytesAndAsLongAsTheyMayBe) {
  const std::string bytes = "\x09\x01\x02\x03\x04\x05\x06\x07\x08\x08"s + std::string(9, '\xff') + "\x01"s;
  ProtobufReader reader(bytes);
  EXPECT_FALSE(reader.at_end());
  EXPECT_EQ(reader.next()->value, 0x0807'0605'0403'0201U);                     // field 1, fixed64
  EXPECT_EQ(reader.next()->value, std::numeric_limits<std::uint64_t>::max());  // nine times seven bits and one
  EXPECT_TRUE(reader.at_end());
}

TEST(Protobuf, ReadsAPairOfTextsInEitherOrder) {
  EXPECT_EQ(text_pair_of("\x0a\x01k\x12\x02vw"s), std::pair("k"s, "vw"s));
  EXPECT_EQ(text_pair_of("\x12\x02vw\x1a\x01x\x0a\x01k"s), std::pair("k"s, "vw"s));
  EXPECT_NE(refusal([] { (void)text_pair_of("\x08\x01"s); }).find("a text that is a number"), std::string::npos);
}

TEST(Protobuf, KnowsFieldsUpToTheLastNumberThereIs) {
  const std::string last = "\xf8\xff\xff\xff\x0f\x07"s;  // 2^29 - 1, a varint
  ProtobufReader reader(last);
  EXPECT_EQ(reader.next()->number, 0x1FFF'FFFFU);
  EXPECT_NE(refusal([] { read_all("\x80\x80\x80\x80\x10\x07"s); }).find("without a number"), std::string::npos);  // 2^29
}

TEST(Protobuf, RefusesWhatIsCutShortOrUnknown) {
  EXPECT_NE(refusal([] { read_all("\x12\x07test"s); }).find("cut short"), std::string::npos);
  EXPECT_NE(refusal([] { read_all("\x0d\x00"s); }).find("cut short"), std::string::npos);
  EXPECT_NE(refusal([] { read_all("\x08"s + std::string(11, '\xff')); }).find("does not end"), std::string::npos);
  EXPECT_NE(refusal([] { read_all("\x0b"s); }).find("unknown kind"), std::string::npos);  // a group
  EXPECT_NE(refusal([] { read_all("\x00\x00"s); }).find("without a number"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
