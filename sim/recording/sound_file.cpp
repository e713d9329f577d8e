#include "sim/recording/sound_file.hpp"

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "sim/recording/riff.hpp"

namespace earshot::recording {

namespace {

constexpr std::size_t kPiece_samples = 65'536;

host::BadInput refused(const std::filesystem::path& path, const std::string& why) {
  return host::BadInput(path.string() + ": " + why);
}

}  // namespace

struct SoundFile::Handle {
  SNDFILE* file = nullptr;
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  /// @return what its header says
  SF_INFO open(const std::filesystem::path& path) {
    SF_INFO info{};
    // Absolute: libsndfile takes - for standard input.
    file = sf_open(std::filesystem::absolute(path).c_str(), SFM_READ, &info);
    if (file == nullptr) throw refused(path, std::string("is no sound file that can be read: ") + sf_strerror(nullptr));
    return info;
  }

  void close() {
    if (file != nullptr) sf_close(file);
    file = nullptr;
  }
};

namespace {

/// Of one sample; zero where the coding loses something.
int bits_of(int subtype) {
  switch (subtype) {
    case SF_FORMAT_PCM_S8:
    case SF_FORMAT_PCM_U8:
      return 8;
    case SF_FORMAT_PCM_16:
      return 16;
    case SF_FORMAT_PCM_24:
    case SF_FORMAT_FLOAT:
    case SF_FORMAT_DOUBLE:
      return 24;
    case SF_FORMAT_PCM_32:
      return 32;
    default:
      return 0;
  }
}

std::string text_of(SNDFILE* file, int which) {
  const char* text = sf_get_string(file, which);
  return text == nullptr ? std::string() : std::string(text);
}

SoundFormat format_of(const SF_INFO& info, const std::filesystem::path& path) {
  const int subtype = info.format & SF_FORMAT_SUBMASK;
  const bool is_float = subtype == SF_FORMAT_FLOAT || subtype == SF_FORMAT_DOUBLE;
  const int bits = bits_of(subtype);
  if (bits == 0 || (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_RAW)
    throw refused(path, "its samples are coded with loss, which changes levels: convert it to WAV or FLAC from the original");
  if (info.channels < 1) throw refused(path, "it has no channel");
  if (info.samplerate < 1) throw refused(path, "its sample rate is no number above 0 Hz");
  return {.sample_rate = Hertz{static_cast<double>(info.samplerate)},
          .channels = static_cast<std::size_t>(info.channels),
          .bits = bits,
          .is_float = is_float};
}

/// What the file's length says is missing of a WAV file.
std::uint64_t missing_frames_of(const std::filesystem::path& path, std::uint64_t frames) {
  const std::optional<RiffData> data = riff_data(path);
  if (!data || data->there >= data->told || frames == 0) return 0;
  const double share = static_cast<double>(data->told) / static_cast<double>(std::max<std::uint64_t>(data->there, 1));
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(frames) * share)) - frames;
}

/// Room for some whole frames.
std::vector<float> piece_of(const SoundFormat& format) {
  return std::vector<float>(std::max<std::size_t>(kPiece_samples / format.channels, 1) * format.channels);
}

}  // namespace

SoundFile::SoundFile(const std::filesystem::path& path) : handle_(std::make_unique<Handle>()) {
  { const host::InputFile is_regular(path, host::kAnySize); }
  const SF_INFO info = handle_->open(path);
  format_ = format_of(info, path);
  frames_ = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
  if (info.frames == SF_COUNT_MAX) {  // a FLAC file that was written into a pipe does not say how long it is
    frames_ = 0;
    std::vector<float> piece = piece_of(format_);
    while (const std::size_t frames = read(piece)) frames_ += frames;
    handle_->close();
    (void)handle_->open(path);
  }
  if (frames_ == 0) throw refused(path, "holds no sample");
  missing_frames_ = missing_frames_of(path, frames_);
  texts_ = {.artist = text_of(handle_->file, SF_STR_ARTIST),
            .album = text_of(handle_->file, SF_STR_ALBUM),
            .comment = text_of(handle_->file, SF_STR_COMMENT),
            .date = text_of(handle_->file, SF_STR_DATE),
            .software = text_of(handle_->file, SF_STR_SOFTWARE)};
}

SoundFile::~SoundFile() = default;

std::size_t SoundFile::read(std::span<float> into) {
  const auto room = static_cast<sf_count_t>(into.size() / format_.channels);
  return static_cast<std::size_t>(std::max<sf_count_t>(sf_readf_float(handle_->file, into.data(), room), 0));
}

double largest_magnitude(const std::filesystem::path& path) {
  SoundFile file(path);
  std::vector<float> piece = piece_of(file.format());
  float largest = 0.0F;
  while (const std::size_t frames = file.read(piece)) {
    for (const float sample : std::span(piece).first(frames * file.format().channels))
      if (std::isfinite(sample)) largest = std::max(largest, std::abs(sample));
  }
  return static_cast<double>(largest);
}

}  // namespace earshot::recording
