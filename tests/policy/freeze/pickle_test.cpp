#include "policy/freeze/pickle.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "tests/policy/freeze/bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;
using Kind = PickleValue::Kind;
using namespace std::string_literals;

const PickleRules kNothing{.may_name = [](std::string_view) { return false; }, .may_call = [](std::string_view) { return false; }};
const PickleRules kNames{.may_name = [](std::string_view) { return true; }, .may_call = [](std::string_view) { return false; }};
const PickleRules kCalls{.may_name = [](std::string_view) { return true; }, .may_call = [](std::string_view) { return true; }};

std::string refused(const std::string& bytes, const PickleRules& rules) {
  return refusal([&] { (void)read_pickle(bytes, rules); });
}

// pickle.dumps({"a": [1, 300, -2], "b": (True, None, 1.5)}, protocol=2), as Python 3.11 writes it.
const std::string kPlain =
    "\x80\x02}q\x00(X\x01\x00\x00\x00"
    "aq\x01]q\x02(K\x01M,\x01J\xfe\xff\xff\xff"
    "eX\x01\x00\x00\x00"
    "bq\x03\x88NG?\xf8\x00\x00\x00\x00\x00\x00\x87q\x04u."s;

TEST(Pickle, ReadsPlainDataThatPythonWrote) {
  const Pickle pickle = read_pickle(kPlain, kNothing);
  const PickleValue& top = pickle.top();
  ASSERT_EQ(top.kind, Kind::kDictionary);
  ASSERT_EQ(top.items.size(), 4U);
  EXPECT_EQ(pickle.at(top.items[0]).text, "a");
  const PickleValue& list = pickle.at(top.items[1]);
  ASSERT_EQ(list.items.size(), 3U);
  EXPECT_EQ(pickle.at(list.items[0]).integer, 1);
  EXPECT_EQ(pickle.at(list.items[1]).integer, 300);
  EXPECT_EQ(pickle.at(list.items[2]).integer, -2);
  const PickleValue& tuple = pickle.at(top.items[3]);
  ASSERT_EQ(tuple.kind, Kind::kTuple);
  EXPECT_EQ(pickle.at(tuple.items[0]).kind, Kind::kBoolean);
  EXPECT_EQ(pickle.at(tuple.items[1]).kind, Kind::kNone);
  EXPECT_EQ(pickle.at(tuple.items[2]).real, 1.5);
}

// pickle.dumps({"a": (False,), "b": (1, 2), "c": [], "long": -70000}, protocol=4), as Python 3.11 writes it.
const std::string kProtocol4 =
    "\x80\x04\x95(\x00\x00\x00\x00\x00\x00\x00}\x94(\x8c\x01"
    "a\x94\x89\x85\x94\x8c\x01"
    "b\x94K\x01K\x02\x86\x94\x8c\x01"
    "c\x94]\x94\x8c\x04long\x94J\x90\xee\xfe\xffu."s;

TEST(Pickle, ReadsPlainDataOfALaterProtocol) {
  const Pickle pickle = read_pickle(kProtocol4, kNothing);
  const auto value = [&](std::size_t i) { return pickle.at(pickle.top().items.at(i)); };
  ASSERT_EQ(pickle.top().items.size(), 8U);
  EXPECT_EQ(value(0).text, "a");
  ASSERT_EQ(value(1).kind, Kind::kTuple);
  ASSERT_EQ(value(1).items.size(), 1U);
  EXPECT_EQ(pickle.at(value(1).items[0]).kind, Kind::kBoolean);
  EXPECT_EQ(pickle.at(value(1).items[0]).integer, 0);
  ASSERT_EQ(value(3).items.size(), 2U);
  EXPECT_EQ(pickle.at(value(3).items[0]).integer, 1);
  EXPECT_EQ(pickle.at(value(3).items[1]).integer, 2);
  EXPECT_EQ(value(5).kind, Kind::kList);
  EXPECT_EQ(value(7).integer, -70'000);
}

TEST(Pickle, ReadsProtocolsTwoToFive) {
  for (const char protocol : {'\x02', '\x05'}) EXPECT_EQ(refused("\x80"s + protocol + "N.", kNothing), "");
  for (const char protocol : {'\x01', '\x06'})
    EXPECT_NE(refused("\x80"s + protocol + "N.", kNothing).find("unknown protocol"), std::string::npos);
}

TEST(Pickle, AddsToWhatStandsOnTop) {
  // pickle.dumps([[7], [7]], protocol=2) and pickle.dumps({"k": 7}, protocol=2)
  const Pickle lists = read_pickle("\x80\x02]q\x00(]q\x01K\x07"s + "a]q\x02K\x07" + "ae.", kNothing);
  ASSERT_EQ(lists.top().items.size(), 2U);
  for (const std::size_t inner : lists.top().items) {
    ASSERT_EQ(lists.at(inner).items.size(), 1U);
    EXPECT_EQ(lists.at(lists.at(inner).items[0]).integer, 7);
  }
  const Pickle dictionary = read_pickle("\x80\x02}q\x00X\x01\x00\x00\x00kq\x01K\x07s."s, kNothing);
  ASSERT_EQ(dictionary.top().items.size(), 2U);
  EXPECT_EQ(dictionary.at(dictionary.top().items[0]).text, "k");
  EXPECT_EQ(dictionary.at(dictionary.top().items[1]).integer, 7);
  EXPECT_NE(refused("\x80\x02K\x01K\x07"s + "a.", kNothing).find("expected a list"), std::string::npos);
  EXPECT_NE(refused("\x80\x02]K\x01K\x07s."s, kNothing).find("expected a dictionary"), std::string::npos);
  EXPECT_NE(refused("\x80\x02}(K\x01u."s, kNothing).find("a key without a value"), std::string::npos);
  EXPECT_NE(refused("\x80\x02](K\x07"s + "a.", kNothing).find("expected a list"), std::string::npos) << "it stands below the mark";
}

TEST(Pickle, RecallsWhatItRememberedByShortAndLongNumbers) {
  const auto text_of = [](const std::string& bytes) { return read_pickle(bytes, kNothing).top().items; };
  // The first value is put at 1000 and the second at 7; a tuple of the first, the second and the first again.
  EXPECT_EQ(text_of("\x80\x02K\x01r\xe8\x03\x00\x00K\x02q\x07j\xe8\x03\x00\x00\x87."s), (std::vector<std::size_t>{0, 1, 0}));
  EXPECT_EQ(text_of("\x80\x02K\x01r\xe8\x03\x00\x00K\x02q\x07h\x07\x87."s), (std::vector<std::size_t>{0, 1, 1}));
  EXPECT_EQ(text_of("\x80\x04K\x01\x94K\x02\x94h\x01\x87."s), (std::vector<std::size_t>{0, 1, 1})) << "memoised as 0, 1";
  EXPECT_NE(refused("\x80\x02q\x00N."s, kNothing).find("remembers a value that is not there"), std::string::npos);
  EXPECT_TRUE(support::has_line(refused("\x80\x02h\x00."s, kNothing), {"recalls", "value", "never remembered"}));
}

TEST(Pickle, TakesOnlyADictionaryForItsOwnAttributes) {
  EXPECT_EQ(refused("\x80\x02}}b."s, kNothing), "");
  EXPECT_NE(refused("\x80\x02]}b."s, kNothing).find("expected a dictionary"), std::string::npos);
  EXPECT_NE(refused("\x80\x02}]b."s, kNothing).find("expected a dictionary"), std::string::npos);
}

TEST(Pickle, ReadsACallOfTheDictionaryThatKeepsItsOrderAsADictionary) {
  const std::string ordered =
      "\x80\x02"
      "ccollections\nOrderedDict\n";
  EXPECT_EQ(read_pickle(ordered + ")R.", kCalls).top().kind, Kind::kDictionary);
  EXPECT_EQ(read_pickle(ordered + "N\x85R.", kCalls).top().kind, Kind::kCall) << "of what it is given nothing is known";
  EXPECT_EQ(read_pickle("\x80\x02"
                        "cmodule\nname\n)R.",
                        kCalls)
                .top()
                .kind,
            Kind::kCall);
  EXPECT_NE(refused("\x80\x02N)R.", kCalls).find("calls what is no function"), std::string::npos);
  EXPECT_NE(refused(ordered + "NR.", kCalls).find("calls what is no function"), std::string::npos);
}

TEST(Pickle, WritesDownWhatLiesOutsideOfIt) {
  const Pickle pickle = read_pickle("\x80\x02K\x07Q.", kNothing);
  EXPECT_EQ(pickle.top().kind, Kind::kPersistent);
  EXPECT_EQ(pickle.at(pickle.top().items.at(0)).integer, 7);
}

TEST(Pickle, IsReadUpToOneMebibyte) {
  const auto of_size = [](std::size_t size) {  // a text that fills it
    const std::size_t text = size - 8;
    std::string bytes = "\x80\x02X";
    for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(text >> shift & 0xFFU));
    return bytes + std::string(text, 'x') + ".";
  };
  constexpr std::size_t kMost = std::size_t{1024} * 1024;
  ASSERT_EQ(of_size(kMost).size(), kMost);
  EXPECT_EQ(refused(of_size(kMost), kNothing), "");
  EXPECT_NE(refused(of_size(kMost + 1), kNothing).find("over 1 MiB"), std::string::npos);
}

TEST(Pickle, OnlyWritesDownWhatItNames) {
  const Pickle pickle = read_pickle(
      "\x80\x02"
      "cos\nsystem\n.",
      kNames);
  EXPECT_EQ(pickle.top().kind, Kind::kGlobal);
  EXPECT_EQ(pickle.top().text, "os.system");
}

TEST(Pickle, RefusesACallThatPythonWouldMake) {
  const support::TemporaryFolder folder;
  const std::filesystem::path proof = folder / "executed";
  const std::string command = "touch " + proof.string();
  const std::string attack =
      "\x80\x02"
      "cos\nsystem\nX"s +
      static_cast<char>(command.size()) + "\0\0\0"s + command + "\x85R.";
  EXPECT_NE(refused(attack, kNothing).find("names os.system"), std::string::npos);
  EXPECT_NE(refused(attack, kNames).find("calls os.system"), std::string::npos);
  EXPECT_EQ(read_pickle(attack, kCalls).top().kind, Kind::kCall);
  EXPECT_FALSE(std::filesystem::exists(proof));
}

TEST(Pickle, RefusesEveryOtherWayToCallSomething) {
  EXPECT_NE(refused("\x80\x02(X\x02\x00\x00\x00lsios\nsystem\n."s, kCalls).find("opcode 0x69"), std::string::npos);   // INST
  EXPECT_NE(refused("\x80\x02(cos\nsystem\nX\x02\x00\x00\x00lso."s, kCalls).find("opcode 0x6f"), std::string::npos);  // OBJ
  EXPECT_NE(refused("\x80\x02"
                    "cos\nsystem\n)\x81."s,
                    kCalls)
                .find("opcode 0x81"),
            std::string::npos);  // NEWOBJ
  EXPECT_NE(refused("\x80\x04"
                    "cos\nsystem\n)}\x92."s,
                    kCalls)
                .find("opcode 0x92"),
            std::string::npos);                                                             // NEWOBJ_EX
  EXPECT_NE(refused("\x80\x02\x82\x01."s, kCalls).find("opcode 0x82"), std::string::npos);  // EXT1
  EXPECT_NE(refused("\x80\x02"
                    "cos\nsystem\n)Rcos\nsystem\nb."s,
                    kCalls)
                .find("expected a dictionary"),
            std::string::npos);  // BUILD
}

TEST(Pickle, RefusesEveryOpcodeItDoesNotKnow) {
  const std::string known = "(.NJKMGXaebc})hjqrRsut]Q\x80\x85\x86\x87\x88\x89\x8c\x93\x94\x95";
  for (int code = 0; code < 256; ++code) {
    const char opcode = static_cast<char>(code);
    if (known.find(opcode) != std::string::npos) continue;
    EXPECT_NE(refused("\x80\x02"s + opcode + std::string(64, '\n'), kCalls).find("opcode 0x"), std::string::npos) << code;
  }
}

TEST(Pickle, RefusesEveryBeginningOfAWholeOne) {
  for (std::size_t size = 0; size < kPlain.size(); ++size) {
    EXPECT_NE(refused(kPlain.substr(0, size), kNothing), "") << size;
  }
  EXPECT_NE(refused(kPlain + ".", kNothing).find("after its end"), std::string::npos);
}

TEST(Pickle, RefusesToTakeWhatIsNotThere) {
  for (const std::string& bytes : {"\x80\x02."s, "\x80\x02\x85."s, "\x80\x02t."s, "\x80\x02h\x07."s, "\x80\x02q\x00N."s, "\x80\x02N\x61."s,
                                   "\x80\x02}(Nu."s, "\x80\x02(N\x85t."s + "", "\x80\x02N(\x85."s}) {
    if (bytes == "\x80\x02(N\x85t."s) continue;  // a tuple in a tuple: whole
    EXPECT_NE(refused(bytes, kCalls), "") << testing::PrintToString(bytes);
  }
}

TEST(Pickle, TakesAListThatHoldsItself) {
  const Pickle pickle = read_pickle(
      "\x80\x02]q\x00h\x00"
      "a."s,
      kNothing);
  EXPECT_EQ(pickle.top().items, std::vector<std::size_t>{pickle.root});
}

std::string repeated(const std::string& part, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += part;
  return all;
}

std::size_t held_bytes(const Pickle& pickle) {
  std::size_t bytes = 0;
  for (const PickleValue& value : pickle.values) bytes += value.text.size() + value.items.size() * sizeof(std::size_t);
  return bytes;
}

TEST(Pickle, RefusesACallWithMoreArgumentsThanAnyThatWeightsNeed) {
  const auto call = [](std::size_t arguments) { return "\x80\x02(cm\nf\n("s + repeated("N", arguments) + "tRt."; };
  EXPECT_EQ(refused(call(8), kCalls), "");
  EXPECT_NE(refused(call(9), kCalls).find("calls m.f with more than 8 arguments"), std::string::npos);
}

TEST(Pickle, RefusesALongNameHoweverItIsGiven) {
  const auto line = [](std::size_t size) { return "\x80\x02" + ("cm\n" + std::string(size - 2, 'f') + "\n."); };
  const auto texts = [](std::size_t size) {
    return "\x80\x04\x8c\x01m\x8c" + (static_cast<char>(size - 2) + std::string(size - 2, 'f') + "\x93.");
  };
  for (const auto& name : {std::function<std::string(std::size_t)>(line), std::function<std::string(std::size_t)>(texts)}) {
    EXPECT_EQ(refused(name(256), kNames), "");
    EXPECT_NE(refused(name(257), kNames).find("a name of more than 256 characters"), std::string::npos);
  }
}

// Bytes that recall what was written once grow by a factor; what is held of them does not.
TEST(Pickle, HoldsNoMoreThanItsBudgetOfTextsAndItems) {
  const std::string text = "\x80\x04(\x8c\x01mq\x00\x8c\xc8"s + std::string(200, 'f') + "q\x01"s;
  const auto names = [&](std::size_t count) { return text + repeated("h\x00h\x01\x93"s, count) + "t."; };
  const std::string tuple = "\x80\x02(cm\nf\nq\x00(NNNNNNNNtq\x01"s;
  const auto calls = [&](std::size_t count) { return tuple + repeated("h\x00h\x01R"s, count) + "t."; };
  constexpr std::size_t kBudget = std::size_t{4} * 1024 * 1024;
  for (const auto& bytes : {std::function<std::string(std::size_t)>(names), std::function<std::string(std::size_t)>(calls)}) {
    EXPECT_LE(held_bytes(read_pickle(bytes(2'000), kCalls)), kBudget);
    EXPECT_NE(refused(bytes(100'000), kCalls).find("holds more than 4 MiB"), std::string::npos);
  }
  const auto list = [](std::size_t count) { return "\x80\x02]("s + repeated("N", count) + "e."; };
  EXPECT_EQ(held_bytes(read_pickle(list(kBudget / sizeof(std::size_t)), kNothing)), kBudget);
  EXPECT_NE(refused(list(kBudget / sizeof(std::size_t) + 1), kNothing).find("holds more than 4 MiB"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
