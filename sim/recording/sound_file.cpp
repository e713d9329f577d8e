#include "sim/recording/sound_file.hpp"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::recording {

namespace {

constexpr std::size_t kPiece_samples = 65'536;

host::BadInput refused(const std::filesystem::path& path, const std::string& why) {
  return host::BadInput(path.string() + ": " + why);
}

}  // namespace

struct SoundFile::Handle {
  /// Samples as libsndfile reads them without a header.
  struct Window {
    std::ifstream stream;
    std::uint64_t begin = 0;
    std::uint64_t bytes = 0;
    std::uint64_t at = 0;  ///< from the begin
  };

  SNDFILE* file = nullptr;
  Window window;
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  /// @return what its header says; nothing where libsndfile cannot read it
  std::optional<SF_INFO> try_open(const std::filesystem::path& path) {
    SF_INFO info{};
    // Absolute: libsndfile takes - for standard input.
    file = sf_open(std::filesystem::absolute(path).c_str(), SFM_READ, &info);
    return file == nullptr ? std::nullopt : std::optional(info);
  }

  SF_INFO open(const std::filesystem::path& path) {
    const std::optional<SF_INFO> info = try_open(path);
    if (!info) throw refused(path, std::string("is no sound file that can be read: ") + sf_strerror(nullptr));
    return *info;
  }

  /// Reads samples past the header. @param info  how they lie
  SF_INFO open_samples(const std::filesystem::path& path, const RiffData& data, SF_INFO info) {
    close();
    window.stream.open(path, std::ios::binary);
    window.begin = data.begin;
    window.bytes = data.there;
    window.at = 0;
    SF_VIRTUAL_IO io{.get_filelen = length_of, .seek = seek, .read = read_bytes, .write = nullptr, .tell = position_of};
    file = sf_open_virtual(&io, SFM_READ, &info, &window);
    if (file == nullptr) throw refused(path, std::string("is no sound file that can be read: ") + sf_strerror(nullptr));
    return info;
  }

  void close() {
    if (file != nullptr) sf_close(file);
    file = nullptr;
  }

 private:
  static sf_count_t length_of(void* user) { return static_cast<sf_count_t>(static_cast<Window*>(user)->bytes); }
  static sf_count_t position_of(void* user) { return static_cast<sf_count_t>(static_cast<Window*>(user)->at); }
  static sf_count_t seek(sf_count_t offset, int whence, void* user) {
    Window& window = *static_cast<Window*>(user);
    const std::uint64_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? window.at : window.bytes;
    window.at = static_cast<std::uint64_t>(std::max<sf_count_t>(static_cast<sf_count_t>(from) + offset, 0));
    return static_cast<sf_count_t>(window.at);
  }
  static sf_count_t read_bytes(void* into, sf_count_t count, void* user) {
    Window& window = *static_cast<Window*>(user);
    if (window.at >= window.bytes) return 0;
    const std::uint64_t most = std::min<std::uint64_t>(static_cast<std::uint64_t>(count), window.bytes - window.at);
    window.stream.clear();
    window.stream.seekg(static_cast<std::streamoff>(window.begin + window.at));
    window.stream.read(static_cast<char*>(into), static_cast<std::streamsize>(most));
    const auto read = std::max<std::streamsize>(window.stream.gcount(), 0);
    window.at += static_cast<std::uint64_t>(read);
    return read;
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

int stored_bits_of(int subtype) {
  if (subtype == SF_FORMAT_DOUBLE) return 64;
  return subtype == SF_FORMAT_FLOAT ? 32 : bits_of(subtype);
}

/// How libsndfile is to read a WAV file's samples without its header; nothing where they are coded.
std::optional<SF_INFO> raw_format(const RiffFormat& format) {
  constexpr int kWhole = 1;
  constexpr int kFloating = 3;
  if (format.channels < 1 || format.bytes_per_frame % format.channels != 0) return std::nullopt;
  const int bytes = format.bytes_per_frame / format.channels;
  int subtype = 0;
  if (format.coding == kWhole && bytes >= 1 && bytes <= 4)
    subtype = std::array{SF_FORMAT_PCM_U8, SF_FORMAT_PCM_16, SF_FORMAT_PCM_24, SF_FORMAT_PCM_32}[static_cast<std::size_t>(bytes) - 1];
  if (format.coding == kFloating && bytes == 4) subtype = SF_FORMAT_FLOAT;
  if (format.coding == kFloating && bytes == 8) subtype = SF_FORMAT_DOUBLE;
  if (subtype == 0) return std::nullopt;
  SF_INFO info{};
  info.samplerate = format.sample_rate_hz;
  info.channels = format.channels;
  info.format = SF_FORMAT_RAW | subtype | SF_ENDIAN_LITTLE;
  return info;
}

SoundFormat format_of(const SF_INFO& info, const std::filesystem::path& path) {
  const int subtype = info.format & SF_FORMAT_SUBMASK;
  const bool is_float = subtype == SF_FORMAT_FLOAT || subtype == SF_FORMAT_DOUBLE;
  const int bits = bits_of(subtype);
  if (bits == 0) throw refused(path, "its samples are coded with loss, which changes levels: convert it to WAV or FLAC from the original");
  if (info.channels < 1) throw refused(path, "it has no channel");
  if (info.samplerate < 1) throw refused(path, "its sample rate is no number above 0 Hz");
  return {.sample_rate = Hertz{static_cast<double>(info.samplerate)},
          .channels = static_cast<std::size_t>(info.channels),
          .bits = bits,
          .stored_bits = stored_bits_of(subtype),
          .is_float = is_float};
}

/// Room for some whole frames.
std::vector<float> piece_of(const SoundFormat& format) {
  return std::vector<float>(std::max<std::size_t>(kPiece_samples / format.channels, 1) * format.channels);
}

}  // namespace

std::string to_string(const SoundFormat& format) {
  return std::to_string(format.stored_bits) + (format.is_float ? " bit floating point" : " bit");
}

SoundFile::SoundFile(const std::filesystem::path& path) : handle_(std::make_unique<Handle>()) {
  { const host::InputFile is_regular(path, host::kAnySize); }
  const std::optional<RiffFile> riff = read_riff(path);
  if (riff) {
    open_riff(path, *riff);
  } else {
    const SF_INFO info = handle_->open(path);
    format_ = format_of(info, path);
    frames_ = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
    if (info.frames == SF_COUNT_MAX) count_frames(path);
  }
  if (frames_ == 0) throw refused(path, "holds no sample");
  if (riff) texts_ = texts_of(path, *riff);
  const auto take = [this](std::string& text, int which) {
    if (text.empty()) text = text_of(handle_->file, which);
  };
  take(texts_.artist, SF_STR_ARTIST);
  take(texts_.album, SF_STR_ALBUM);
  take(texts_.comment, SF_STR_COMMENT);
  take(texts_.date, SF_STR_DATE);
  take(texts_.software, SF_STR_SOFTWARE);
  if (!riff || !riff->format || texts_.harp.empty()) return;
  format_.sample_rate = harp_rate(texts_.harp, format_.channels).value_or(format_.sample_rate);
  runs_ = harp_runs(texts_.harp, {.begin = riff->data.begin,
                                  .frame_bytes = static_cast<std::uint64_t>(std::max(riff->format->bytes_per_frame, 1)),
                                  .frames = frames_,
                                  .channels = format_.channels,
                                  .sample_rate = format_.sample_rate});
}

/// A FLAC file that was written into a pipe, or by a recorder that was killed, does not say how long it is.
void SoundFile::count_frames(const std::filesystem::path& path) {
  frames_ = 0;
  declared_length_ = DeclaredLength::kUnknown;
  std::vector<float> piece = piece_of(format_);
  while (const std::size_t frames = read(piece)) frames_ += frames;
  handle_->close();
  (void)handle_->open(path);
}

void SoundFile::open_riff(const std::filesystem::path& path, const RiffFile& riff) {
  const RiffData& data = riff.data;
  const std::optional<SF_INFO> raw = riff.format ? raw_format(*riff.format) : std::nullopt;
  const bool is_size_right = data.declared && data.there <= *data.declared;
  std::optional<SF_INFO> info = raw && !is_size_right ? std::nullopt : handle_->try_open(path);
  if (!info) info = raw ? handle_->open_samples(path, data, *raw) : handle_->open(path);
  format_ = format_of(*info, path);
  frames_ = static_cast<std::uint64_t>(std::max<sf_count_t>(info->frames, 0));
  const std::uint64_t frame_bytes =
      riff.format && riff.format->bytes_per_frame > 0 ? static_cast<std::uint64_t>(riff.format->bytes_per_frame) : 1;
  frames_elsewhere_ = data.elsewhere / frame_bytes;
  if (!data.declared) {
    declared_length_ = DeclaredLength::kUnknown;
  } else if (*data.declared > data.there && frames_ > 0) {
    missing_frames_ = (*data.declared - data.there) / frame_bytes;
    if (missing_frames_ > 0) declared_length_ = DeclaredLength::kTooLong;
  } else if (data.there > *data.declared) {
    frames_behind_ = (data.there - *data.declared) / frame_bytes;
    if (frames_behind_ > 0) declared_length_ = DeclaredLength::kTooShort;
  }
}

bool SoundFile::go_to(std::uint64_t frame) {
  return sf_seek(handle_->file, static_cast<sf_count_t>(frame), SEEK_SET) == static_cast<sf_count_t>(frame);
}

SoundFile::~SoundFile() = default;

std::size_t SoundFile::read(std::span<float> into) {
  const auto room = static_cast<sf_count_t>(into.size() / format_.channels);
  return static_cast<std::size_t>(std::max<sf_count_t>(sf_readf_float(handle_->file, into.data(), room), 0));
}

double largest_magnitude(const std::filesystem::path& path, const std::function<void()>& tick) {
  SoundFile file(path);
  std::vector<float> piece = piece_of(file.format());
  float largest = 0.0F;
  while (const std::size_t frames = file.read(piece)) {
    for (const float sample : std::span(piece).first(frames * file.format().channels))
      if (std::isfinite(sample)) largest = std::max(largest, std::abs(sample));
    tick();
  }
  return static_cast<double>(largest);
}

}  // namespace earshot::recording
