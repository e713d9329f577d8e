#include "policy/freeze/zip_archive.hpp"

#include <gtest/gtest.h>

#include "firmware/host/toml/table_reader.hpp"
#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;

TEST(ZipArchive, UnpacksWhatWasPacked) {
  const std::string text(100'000, 'x');  // packs to a few hundred bytes
  const std::string bytes = test::zip_of({{"a", "alpha"}, {"folder/data.pkl", text}});
  EXPECT_LT(bytes.size(), 2'000U);
  const ZipArchive archive(bytes);
  EXPECT_EQ(archive.read("a"), "alpha");
  EXPECT_EQ(archive.read(archive.name_ending_in("/data.pkl")), text);
  EXPECT_FALSE(archive.has("b"));
}

TEST(ZipArchive, RefusesWhatIsNoArchive) {
  EXPECT_NE(refusal([] { ZipArchive("not a zip"); }).find("not a zip archive"), std::string::npos);
  EXPECT_NE(refusal([] { ZipArchive(""); }).find("not a zip archive"), std::string::npos);
  const std::string whole = test::zip_of({{"a", "alpha"}});
  EXPECT_NE(refusal([&] { ZipArchive(std::string_view(whole).substr(0, whole.size() - 10)); }).find("cut short"), std::string::npos);
}

TEST(ZipArchive, RefusesAnEntryWhoseBytesDoNotMatchTheirChecksum) {
  std::string bytes = test::model("memory.zip");  // stored, not packed
  const std::size_t at = bytes.find("mlp_extractor.policy_net.0.weight");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'n';
  const ZipArchive archive(bytes);
  EXPECT_NE(refusal([&] { (void)archive.read("policy.pth"); }).find("damaged"), std::string::npos);
}

TEST(ZipArchive, RefusesAnEntryThatUnpacksToMoreThanItMay) {
  const std::string bytes = test::zip_of({{"bomb", std::string(ZipArchive::kMaxEntryBytes + 1, '\0')}});
  EXPECT_LT(bytes.size(), 100'000U);
  const ZipArchive archive(bytes);
  EXPECT_NE(refusal([&] { (void)archive.read("bomb"); }).find("over 16 MiB"), std::string::npos);
}

TEST(ZipArchive, UnpacksAnEntryOfJustAsMuchAsItMay) {
  const std::string bytes = test::zip_of({{"large", std::string(ZipArchive::kMaxEntryBytes, 'x')}});
  EXPECT_EQ(ZipArchive(bytes).read("large"), std::string(ZipArchive::kMaxEntryBytes, 'x'));
}

TEST(ZipArchive, RefusesAnEntryPackedByAMethodThatNobodyKnows) {
  std::string bytes = test::zip_of({{"a", "alpha"}});
  bytes[bytes.find("PK\x03\x04") + 8] = 77;   // the method, in the entry itself
  bytes[bytes.find("PK\x01\x02") + 10] = 77;  // and in the directory
  const ZipArchive archive(bytes);
  EXPECT_NE(refusal([&] { (void)archive.read("a"); }).find("entry a cannot be unpacked"), std::string::npos);
}

TEST(ZipArchive, RefusesTwoEntriesOfOneName) {
  std::string bytes = test::zip_of({{"a", "alpha"}, {"b", "beta"}});
  bytes[bytes.find("PK\x01\x02", bytes.find("PK\x01\x02") + 1) + 46] = 'a';  // of the directory's second entry
  EXPECT_NE(refusal([&] { ZipArchive{bytes}; }).find("names an entry twice"), std::string::npos);
}

TEST(ZipArchive, SaysWhichEntryIsMissing) {
  const std::string bytes = test::zip_of({{"a/data.pkl", ""}, {"b/data.pkl", ""}});
  const ZipArchive archive(bytes);
  EXPECT_NE(refusal([&] { (void)archive.read("c"); }).find("no entry c"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)archive.name_ending_in("/data.pkl"); }).find("more than one"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)archive.name_ending_in(".txt"); }).find("no entry ends"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
