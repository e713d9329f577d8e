#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::tests {

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// `earshot listen`, with a folder of the running test's own; what it is told to write goes into out/ there.
class ListenProgram : public testing::Test {
 protected:
  ListenProgram() { std::filesystem::create_directories(folder_ / "out"); }

  int run(const std::string& arguments) {
    const std::string command = std::string(EARSHOT_BIN_DIR) + "/earshot-listen " + arguments + " >" + (folder_ / "stdout").string() +
                                " 2>" + (folder_ / "stderr").string();
    const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string said() const { return content_of(folder_ / "stdout"); }
  [[nodiscard]] std::string errors() const { return content_of(folder_ / "stderr"); }
  [[nodiscard]] std::string out(const std::string& name) const { return (folder_ / "out" / name).string(); }

  /// With every output asked for: exit status 2, one line on standard error that mentions this, and nothing written.
  void expect_refused(const std::string& arguments, const std::string& mentioned) {
    EXPECT_EQ(run(arguments + " --csv " + out("a.csv") + " --raven " + out("a.txt") + " --json " + out("a.json") + " --levels " +
                  out("a.nc") + " --spectrogram " + out("a.png")),
              2);
    EXPECT_NE(errors().find(mentioned), std::string::npos) << errors();
    EXPECT_EQ(said(), "");
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
  }

  /// Noise of a root mean square of 0.02 with calls of 1 s at 20 Hz, at 1 kHz: a sine of 0.05 has 0.00125, and white noise
  /// 0.0004 * 15 / 500 in the band of 15 to 30 Hz, 20.2 dB less.
  [[nodiscard]] static std::vector<float> song(std::size_t seconds, const std::vector<double>& calls_s, double amplitude = 0.05) {
    Pcg32 random(3);
    std::vector<float> samples(1000 * seconds);
    for (float& sample : samples) {
      double sum = -6.0;  // twelve even numbers make about a normal one
      for (int i = 0; i < 12; ++i) sum += static_cast<double>(random.next()) / 4294967296.0;
      sample = static_cast<float>(0.02 * sum);
    }
    for (const double call_s : calls_s)
      for (std::size_t i = 0; i < 1000; ++i)
        samples[static_cast<std::size_t>(1000.0 * call_s) + i] +=
            static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * 0.02 * static_cast<double>(i)));
    return samples;
  }

  [[nodiscard]] static std::string sixteen_bits(const std::vector<float>& samples) {
    std::vector<int> values;
    values.reserve(samples.size());
    for (const float sample : samples) values.push_back(static_cast<int>(std::lround(std::clamp(32768.0F * sample, -32768.0F, 32767.0F))));
    return int16_samples(values);
  }

  /// @return its path
  std::string wav(const std::string& name, const std::vector<float>& samples) {
    write(folder_ / name, WavBytes{.sample_rate = 1000, .samples = sixteen_bits(samples)}.bytes());
    return (folder_ / name).string();
  }

  /// The columns of a table of one header line.
  [[nodiscard]] static std::vector<std::vector<std::string>> rows_of(const std::string& text, char separator) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, separator);) rows.back().push_back(cell);
    }
    return rows;
  }

  const support::TemporaryFolder folder_;
};

}  // namespace earshot::tests
