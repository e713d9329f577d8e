// fin_song SOUND.wav|SOUND.flac TRUTH.txt [--steady]: five minutes of a made fin whale's song in noise, and where each call lies as a Raven
// selection table. The same bytes on every machine and in every run. For trying `earshot listen` without a recording.

#include <sndfile.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string_view>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "sim/annotation/selection_table.hpp"

namespace {

using namespace earshot;

constexpr int kRate_hz = 1000;
constexpr int kSeconds = 300;
constexpr double kNoise = 0.02;  ///< root mean square of white noise, shares of full scale
constexpr double kCall_s = 1.0;
constexpr double kFirst_s = 7.5;
constexpr double kInterval_s = 15.0;
constexpr host::OutputKind kSound{"a sound file", {"RIFF", "fLaC"}};

/// About normal: twelve evenly distributed numbers, the Irwin-Hall distribution.
double noise(Pcg32& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random.next()) / 4294967296.0;
  return sum;
}

/// A pulse that falls from 23 to 18 Hz under a Hann window, its mean square 1.
double pulse(double t_s) {
  const double phase = 2.0 * std::numbers::pi * (23.0 * t_s - 2.5 * t_s * t_s / kCall_s);
  const double window = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * t_s / kCall_s);
  return std::sqrt(16.0 / 3.0) * window * std::sin(phase);
}

/// How loud the calls of a song are after the first one.
enum class Loudness : std::uint8_t { kFading, kSteady };

/// 25 dB over the noise of the band of 15 to 30 Hz; fading: from there to 6 dB.
double amplitude(int call, int calls, Loudness loudness) {
  const double snr_db = loudness == Loudness::kSteady ? 25.0 : 25.0 - 19.0 * call / (calls - 1);
  const double noise_power = kNoise * kNoise * 15.0 / (0.5 * kRate_hz);
  return std::sqrt(noise_power * std::pow(10.0, snr_db / 10.0));
}

void write_sound(const std::filesystem::path& path, const std::vector<float>& samples) {
  host::OutputFile file(path);
  const int container = path.extension() == ".flac" ? SF_FORMAT_FLAC : SF_FORMAT_WAV;
  SF_INFO info{.frames = 0, .samplerate = kRate_hz, .channels = 1, .format = container | SF_FORMAT_PCM_16, .sections = 0, .seekable = 0};
  SNDFILE* sound = sf_open(file.partial().c_str(), SFM_WRITE, &info);
  if (sound == nullptr) throw host::BadInput(path.string() + ": cannot be written: " + sf_strerror(nullptr));
  const sf_count_t written = sf_writef_float(sound, samples.data(), static_cast<sf_count_t>(samples.size()));
  if (sf_close(sound) != 0 || written != static_cast<sf_count_t>(samples.size()))
    throw host::BadInput(path.string() + ": cannot be written; is the disk full?");
  file.commit(host::OutputFile::Survives::kProcess);
}

void make(const std::filesystem::path& sound, const std::filesystem::path& truth, Loudness loudness) {
  host::require_writable(sound, kSound, host::Replace::kOwnKind, "another name is needed");
  host::require_writable(truth, annotation::kSelectionOutput, host::Replace::kOwnKind, "another name is needed");
  Pcg32 random(20);
  std::vector<float> samples(static_cast<std::size_t>(kRate_hz) * kSeconds);
  for (float& sample : samples) sample = static_cast<float>(kNoise * noise(random));
  annotation::SelectionTable table;
  const int calls = static_cast<int>(kSeconds / kInterval_s);
  for (int call = 0; call < calls; ++call) {
    const double begin_s = kFirst_s + kInterval_s * call;
    const auto first = static_cast<std::size_t>(begin_s * kRate_hz);
    for (std::size_t i = 0; i < static_cast<std::size_t>(kCall_s * kRate_hz); ++i)
      samples[first + i] += static_cast<float>(amplitude(call, calls, loudness) * pulse(static_cast<double>(i) / kRate_hz));
    table.selections.push_back({.begin_s = begin_s,
                                .end_s = begin_s + kCall_s,
                                .low_hz = 18.0,
                                .high_hz = 23.0,
                                .channel = 1,
                                .begin_file = sound.filename().string(),
                                .file_offset_s = begin_s,
                                .values = {}});
  }
  write_sound(sound, samples);
  host::write_whole(truth, annotation::to_text(table));
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_steady = argc == 4 && std::string_view(argv[3]) == "--steady";
  if (argc != 3 && !is_steady) {
    std::cerr << "usage: fin_song SOUND.wav|SOUND.flac TRUTH.txt [--steady]\n";
    return 2;
  }
  try {
    make(argv[1], argv[2], is_steady ? Loudness::kSteady : Loudness::kFading);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 2;
  }
}
