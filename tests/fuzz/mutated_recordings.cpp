// mutated_recordings COUNT [FIRST]: see README.md.

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/listening/listening.hpp"
#include "tests/fuzz/numbered_mutants.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;

constexpr std::size_t kHeader_bytes = 400;  ///< where most changes are made: chunks, texts, the first line
constexpr const char* kTable =
    "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq (Hz)\tBegin File\tFile Offset (s)\n"
    "1\tSpectrogram 1\t1\t1.5\t2.5\t15.0\t30.0\ta.wav\t1.5\n"
    "2\tSpectrogram 1\t1\t5.25\t6.0\t15.0\t30.0\ta.wav\t5.25\n";

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

std::size_t below(std::size_t count, Pcg32& random) {
  return random.next() % std::max<std::size_t>(count, 1);
}

/// Ten seconds at 200 Hz.
std::vector<int> noise() {
  Pcg32 random(1);
  std::vector<int> samples(2000);
  for (int& sample : samples) sample = static_cast<int>(random.next() % 4096) - 2048;
  return samples;
}

std::string flac(const std::filesystem::path& path) {
  SF_INFO info{.frames = 0, .samplerate = 200, .channels = 1, .format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16, .sections = 0, .seekable = 0};
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  sf_set_string(file, SF_STR_COMMENT, "Recorded at 19:17:30 24/09/2019 (UTC) by AudioMoth 0 at gain setting 2");
  std::vector<int> samples = noise();
  for (int& sample : samples) sample *= 65'536;
  sf_write_int(file, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(file);
  return host::read_text(path, host::kAnySize);
}

/// Good files, each with the name that it goes by.
std::vector<std::pair<std::string, std::string>> good_files(const support::TemporaryFolder& folder) {
  const std::string chain = tests::info_chunk(
      {{"IART", "icListen"}, {"ICRD", "2024-06-01T05:31:14"}, {"ICMT", "3.000000 V pk, -177 dBV re 1uPa, 32768 = Max Count"}});
  const std::string moth = tests::info_chunk({{"ICMT", "Recorded at 19:17:30 24/09/2019 (UTC+2) by AudioMoth 0 at gain setting 2"}});
  const std::string samples = tests::int16_samples(noise());
  return {{"iclisten.wav", tests::WavBytes{.sample_rate = 200, .before_format = chain, .samples = samples}.bytes()},
          {"audiomoth.wav", tests::WavBytes{.sample_rate = 200, .before_format = moth, .samples = samples}.bytes()},
          {"floats.wav", tests::WavBytes{.sample_rate = 200, .bits = 32, .format = 3, .samples = samples}.bytes()},
          {"song.flac", flac(folder / "song.flac")},
          {"table.txt", kTable}};
}

void put_a_number(std::string& bytes, std::size_t at, Pcg32& random) {
  constexpr std::array<std::uint32_t, 10> kNumbers = {0, 1, 2, 7, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF};
  const std::string number = tests::little_endian(kNumbers[below(kNumbers.size(), random)], 1 + below(4, random));
  for (std::size_t i = 0; i < number.size() && at + i < bytes.size(); ++i) bytes[at + i] = number[i];
}

void put_a_text(std::string& bytes, std::size_t at, Pcg32& random) {
  constexpr std::array<const char*, 12> kTexts = {"\t", "\n", "\r\n", "nan",  "-1",  "1e999", "99999999999999999999",
                                                  "\"", "",   "data", "LIST", "fmt "};
  bytes.replace(at, below(6, random), kTexts[below(kTexts.size(), random)]);
}

std::string mutated(std::string bytes, Pcg32& random) {
  for (std::size_t changes = 1 + below(3, random); changes > 0; --changes) {
    const bool is_early = random.next() % 8 != 0;
    const std::size_t at = below(is_early ? std::min(bytes.size(), kHeader_bytes) : bytes.size(), random);
    switch (below(6, random)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, 1 + below(40, random));
        break;
      case 2:
        bytes.insert(at, 1 + below(40, random), static_cast<char>(random.next()));
        break;
      case 3:
        put_a_text(bytes, at, random);
        break;
      default:
        put_a_number(bytes, at, random);
    }
  }
  return bytes;
}

/// @return how many detections there are
std::size_t listen(const std::filesystem::path& path) {
  const listening::Wanted everything{.every_threshold = false, .spectrogram = true, .levels_interval_s = 60.0};
  listening::Plan plan = listening::plan_for(recording::Sequence({path}), {});
  plan.chain.divisor = listening::divisor_for(listening::largest_magnitude(plan.sequence, [] {}));
  const listening::Heard heard = listening::listen_to(plan, everything, [](double) {});
  const double duration_s = plan.sequence.duration().to_seconds();
  require(heard.listened_s > 0.0 && heard.listened_s < duration_s + 10.0, "it listened longer than the sound is");
  for (const listening::Row& row : heard.rows) {
    require(row.begin_s >= 0.0 && row.begin_s <= duration_s, "a detection lies outside the sound");
    require(std::isfinite(row.snr_db) && std::isfinite(row.level_db) && row.duration_s >= 0.0, "a detection has no level");
  }
  return heard.rows.size();
}

std::size_t read_table(const std::filesystem::path& path) {
  const annotation::SelectionTable table = annotation::read_selection_table(path);
  for (const annotation::Selection& selection : table.selections)
    require(selection.begin_s >= 0.0 && selection.end_s >= selection.begin_s && std::isfinite(selection.end_s),
            "a selection is no span of time");
  return table.selections.size();
}

class Run {
 public:
  void judge(std::uint64_t number) {
    Pcg32 random(number);
    const auto& [name, good] = good_[below(good_.size(), random)];
    const std::filesystem::path path = folder_ / name;
    tests::write(path, mutated(good, random));
    try {
      const bool is_table = name.ends_with(".txt");
      const std::size_t count = is_table ? read_table(path) : listen(path);
      ++counts_[name + (is_table ? ": read" : ": listened to") + (count > 0 ? "" : ", and nothing in it")];
    } catch (const host::BadInput& refusal) {
      require(std::string(refusal.what()).starts_with(path.string()),
              std::string("a refusal does not begin with its file: ") + refusal.what());
      ++counts_[name + ": refused"];
    }
  }

  void describe() const {
    for (const auto& [what, count] : counts_) std::cout << count << "  " << what << "\n";
  }

 private:
  support::TemporaryFolder folder_;
  std::vector<std::pair<std::string, std::string>> good_ = good_files(folder_);
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace

int main(int argc, char** argv) {
  return earshot::fuzz::judge_numbered(
      argc, argv, "mutated_recordings",
      "changes good WAV and FLAC files and Raven tables and listens to them: each must be refused in lines\n"
      "that begin with the file, or heard with every detection inside the sound.",
      "recording", [] { return Run(); });
}
