#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

const std::string kMunk = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";

std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class FieldProgram : public testing::Test {
 protected:
  FieldProgram() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "out");
  }
  ~FieldProgram() override { std::filesystem::remove_all(folder_); }

  int run(const std::string& arguments) {
    const std::string command = std::string(EARSHOT_BIN_DIR) + "/earshot-field " + arguments + " >" + (folder_ / "stdout").string() +
                                " 2>" + (folder_ / "stderr").string();
    const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string errors() const { return read(folder_ / "stderr"); }
  [[nodiscard]] bool nothing_written() const { return std::filesystem::is_empty(folder_ / "out"); }
  [[nodiscard]] std::string output() const { return (folder_ / "out" / "field.nc").string(); }

  /// The shipped ocean with one part changed.
  std::string ocean_with(const std::string& what, const std::string& by) {
    std::string text = read(kMunk);
    text.replace(text.find(what), what.size(), by);
    const auto path = folder_ / "ocean.toml";
    std::ofstream(path) << text;
    return path.string();
  }
  void expect_refused(const std::string& arguments, const std::string& mentioned) {
    EXPECT_EQ(run(arguments), 2);
    EXPECT_NE(errors().find(mentioned), std::string::npos) << errors();
    EXPECT_TRUE(nothing_written());
  }

  const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                        (std::string("field_program_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FieldProgram, WritesAFieldAndNothingElse) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --depth 100 300"), 0) << errors();
  EXPECT_EQ(errors(), "");  // no progress bar into a file
  std::ifstream file(output(), std::ios::binary);
  std::string magic(4, ' ');
  file.read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89HDF");  // NetCDF-4 is HDF5
}

TEST_F(FieldProgram, DrawsAPictureWhenAsked) {
  const auto picture = folder_ / "out" / "field.svg";
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --depth-spacing 100 --plot " + picture.string()), 0) << errors();
  EXPECT_NE(read(picture).find("<svg"), std::string::npos);
}

TEST_F(FieldProgram, RefusesAMissingFile) {
  expect_refused("/nowhere/ocean.toml -o " + output(), "/nowhere/ocean.toml: no such file");
}

TEST_F(FieldProgram, RefusesAnUnknownKey) {
  expect_refused(ocean_with("frequency_hz", "frequency_khz") + " -o " + output(), "source.frequency_khz: unknown key");
}

TEST_F(FieldProgram, RefusesANegativeFrequency) {
  expect_refused(ocean_with("frequency_hz = 20.0", "frequency_hz = -20.0") + " -o " + output(), "source.frequency_hz = -20.0");
}

TEST_F(FieldProgram, RefusesASourceBelowTheBottom) {
  expect_refused(ocean_with("depth_m = 30.0", "depth_m = 3000.0") + " -o " + output(), "must be less than seabed.depth_m");
}

TEST_F(FieldProgram, RefusesAReceiverBelowTheBottom) {
  expect_refused(kMunk + " -o " + output() + " --depth 3001", "receiver depth in m is 3001, allowed: from 0 to 3000");
}

TEST_F(FieldProgram, RefusesAnOutputThatCannotBeWritten) {
  expect_refused(kMunk + " -o /nowhere/field.nc", "/nowhere/field.nc: cannot be written");
}

TEST_F(FieldProgram, RefusesAPictureOfAnUnknownKindBeforeTheWork) {
  expect_refused(kMunk + " -o " + output() + " --max-range-km 1 --plot " + folder_.string() + "/out/field.jpeg",
                 "must end in .png or .svg");
}

TEST_F(FieldProgram, RefusesAnOptionOutOfItsRange) {
  expect_refused(kMunk + " -o " + output() + " --max-range-km=-1", "--max-range-km");
}

}  // namespace
