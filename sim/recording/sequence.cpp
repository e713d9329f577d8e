#include "sim/recording/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "firmware/host/file/bad_input.hpp"
#include "sim/recording/clock_text.hpp"
#include "sim/recording/utc.hpp"

namespace earshot::recording {
namespace {

constexpr double kMicroseconds = 1e6;

Duration duration_of(std::uint64_t frames, Hertz rate) {
  return {static_cast<std::int64_t>(std::llround(static_cast<double>(frames) / rate.value * kMicroseconds))};
}

std::optional<Time> stated_start(const std::filesystem::path& path, const StatedTimes& stated) {
  if (stated.begin || stated.name_format.empty()) return stated.begin;
  const std::optional<ClockTime> time = time_by_format(stated.name_format, path.filename().string());
  if (!time) throw host::BadInput(path.string() + ": its name has no time as --time-format has it: " + stated.name_format);
  return time->utc;
}

/// One, or as many as its recorder's own table of times tells gaps between.
std::vector<Part> parts_of(const std::filesystem::path& path, const SoundFile& file, const StatedTimes& stated) {
  Part whole{.path = path,
             .format = file.format(),
             .notes = notes_of(path, file.texts(), file.format()),
             .file_frames = file.frames(),
             .first_frame = 0,
             .frames = file.frames(),
             .missing_frames = file.missing_frames(),
             .frames_behind = file.frames_behind(),
             .frames_elsewhere = file.frames_elsewhere(),
             .declared_length = file.declared_length()};
  if (const std::optional<Time> start = stated_start(path, stated)) {
    whole.notes.start = start;
    whole.notes.start_from = stated.begin ? "--begin" : "its name by --time-format";
    return {whole};
  }
  std::vector<Part> parts;
  for (const ClockedRun& run : file.runs()) {
    Part part = whole;
    part.notes.recorder = "HARP";
    part.notes.start = run.start;
    part.notes.start_from = "its table of raw files";
    part.first_frame = run.first_frame;
    part.frames = run.frames;
    part.missing_frames = 0;
    parts.push_back(std::move(part));
  }
  if (parts.empty()) return {whole};
  parts.back().missing_frames = whole.missing_frames;
  return parts;
}

void require_alike(const Part& part, const Part& first) {
  const auto refuse = [&](const char* what, double has, double other) {
    std::ostringstream text;
    text << part.path.string() << ": has " << has << ' ' << what << ", " << first.path.string() << " has " << other
         << ": files of one sequence must be alike; listen to them one by one";
    throw host::BadInput(text.str());
  };
  if (part.format.sample_rate != first.format.sample_rate) refuse("Hz", part.format.sample_rate.value, first.format.sample_rate.value);
  if (part.format.channels != first.format.channels)
    refuse("channels", static_cast<double>(part.format.channels), static_cast<double>(first.format.channels));
}

void require_once(const std::vector<Part>& parts, const Part& part) {
  for (const Part& other : parts)
    if (std::filesystem::equivalent(other.path, part.path)) throw host::BadInput(part.path.string() + ": is named twice");
}

/// From the end of one part to the beginning of the next by the recorder's clock; negative where they overlap.
std::optional<Duration> gap_between(const Part& before, const Part& after) {
  if (!before.notes.start || !after.notes.start) return std::nullopt;
  return *after.notes.start - (*before.notes.start + duration_of(before.frames, before.format.sample_rate));
}

bool is_within_clock_step(Duration gap) {
  return gap <= Sequence::kClockStep && Duration{-gap.us} <= Sequence::kClockStep;
}

/// A link counts that leads nowhere, or in a circle.
bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

/// "5.25 s"; "306.25 days" where nobody counts seconds.
std::string seconds_text(Duration duration) {
  constexpr double kDay_s = 86'400.0;
  std::ostringstream text;
  if (duration.to_seconds() >= kDay_s) {
    text << std::round(duration.to_seconds() / kDay_s * 100.0) / 100.0 << " days";
    return text.str();
  }
  text << std::round(duration.to_seconds() * 1000.0) / 1000.0 << " s";
  return text.str();
}

}  // namespace

void Sequence::add(const std::filesystem::path& path, const StatedTimes& stated) {
  std::unique_ptr<SoundFile> file;
  try {
    file = std::make_unique<SoundFile>(path);
  } catch (const host::BadInput& e) {
    if (!is_there(path)) throw;
    unreadable_.emplace_back(e.what());
    return;
  }
  std::vector<Part> parts = parts_of(path, *file, stated);
  require_once(parts_, parts.front());
  if (!parts_.empty()) require_alike(parts.front(), parts_.front());
  for (Part& part : parts) parts_.push_back(std::move(part));
  ++files_;
}

Sequence::Sequence(const std::vector<std::filesystem::path>& paths, const StatedTimes& stated) {
  if (stated.begin && paths.size() > 1)
    throw host::BadInput("--begin: is of one file; --time-format takes the times off the names of several");
  for (const std::filesystem::path& path : paths) add(path, stated);
  if (parts_.empty()) throw host::BadInput(unreadable_.empty() ? "no sound file is named" : unreadable_.front());
  if (std::ranges::all_of(parts_, [](const Part& part) { return part.notes.start.has_value(); }))
    std::ranges::stable_sort(parts_, {}, [](const Part& part) { return *part.notes.start; });
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    parts_[i].begin = parts_[i - 1].begin + parts_[i - 1].frames;
    const std::optional<Duration> gap = gap_between(parts_[i - 1], parts_[i]);
    parts_[i].follows_on = gap && is_within_clock_step(*gap) && parts_[i - 1].missing_frames == 0;
  }
}

Sequence Sequence::of_parts(std::vector<Part> parts) {
  Sequence sequence;
  sequence.parts_ = std::move(parts);
  for (std::size_t i = 1; i < sequence.parts_.size(); ++i)
    sequence.parts_[i].begin = sequence.parts_[i - 1].begin + sequence.parts_[i - 1].frames;
  sequence.files_ = sequence.parts_.size();
  return sequence;
}

Time Sequence::time_of(std::uint64_t frame) const {
  return Time{} + duration_of(frame, sample_rate());
}

Sequence::Place Sequence::place_of(Time in_sequence) const {
  const auto after = std::ranges::upper_bound(parts_, in_sequence, {}, [this](const Part& part) { return time_of(part.begin); });
  const std::size_t index = after == parts_.begin() ? 0 : static_cast<std::size_t>(after - parts_.begin()) - 1;
  const Part& part = parts_[index];
  const Duration in_part = std::max(in_sequence - time_of(part.begin), Duration{});
  Place place{.part = index, .offset = in_part + duration_of(part.first_frame, sample_rate()), .utc = {}};
  if (part.notes.start) place.utc = *part.notes.start + in_part;
  return place;
}

bool Sequence::is_whole() const {
  return unreadable_.empty() && std::ranges::all_of(parts_, [](const Part& part) {
           return part.declared_length == DeclaredLength::kRight && part.frames_elsewhere == 0;
         });
}

std::vector<std::string> Sequence::remarks() const {
  std::vector<std::string> remarks;
  for (const std::string& reason : unreadable_) remarks.push_back(reason + ": left out, the others are listened to");
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.missing_frames > 0)
      remarks.push_back(part.path.string() + ": was cut short: its header announces " +
                        seconds_text(duration_of(part.missing_frames, part.format.sample_rate)) + " more than it holds");
    if (part.first_frame == 0 && part.declared_length == DeclaredLength::kTooShort)
      remarks.push_back(part.path.string() + ": holds " + seconds_text(duration_of(part.frames_behind, part.format.sample_rate)) +
                        " of samples behind the end that its header gives; they are listened to: its recorder was killed, or the size "
                        "wrapped at 4 GiB");
    if (part.first_frame == 0 && part.declared_length == DeclaredLength::kUnknown)
      remarks.push_back(part.path.string() + ": its header does not give its length: it is listened to up to its end, " +
                        seconds_text(duration_of(part.file_frames, part.format.sample_rate)) +
                        "; whether its recorder took more is not known");
    if (part.first_frame == 0 && part.frames_elsewhere > 0)
      remarks.push_back(part.path.string() + ": holds " + seconds_text(duration_of(part.frames_elsewhere, part.format.sample_rate)) +
                        " in a second chunk of samples, where a WAV file has one: they are not listened to");
    if (i == 0) continue;
    const std::optional<Duration> gap = gap_between(parts_[i - 1], part);
    if (!gap) {
      remarks.push_back(part.path.string() + ": whether it follows without a gap is not known: no time is given");
    } else if (!is_within_clock_step(*gap)) {
      const bool is_gap = gap->us > 0;
      remarks.push_back(part.path.string() + ": begins " + seconds_text(is_gap ? *gap : Duration{-gap->us}) +
                        (is_gap ? " after the end of " : " before the end of ") + parts_[i - 1].path.filename().string());
    }
  }
  return remarks;
}

SequenceReader::SequenceReader(const Sequence& sequence, std::size_t channel, double full_scale)
    : sequence_(&sequence), channel_(channel), scale_(static_cast<float>(1.0 / full_scale)) {
  interleaved_.resize(kPieceFrames * sequence.channels());
  samples_.resize(kPieceFrames);
}

bool SequenceReader::open_next() {
  if (file_) ++part_;
  file_.reset();
  if (part_ == sequence_->parts().size()) return false;
  const Part& part = sequence_->parts()[part_];
  file_ = std::make_unique<SoundFile>(part.path);
  if (file_->format().channels != part.format.channels || file_->frames() != part.file_frames)
    throw host::BadInput(part.path.string() + ": has changed while it was listened to");
  if (part.first_frame > 0 && !file_->go_to(part.first_frame))
    throw host::BadInput(part.path.string() + ": cannot be read from its sample " + std::to_string(part.first_frame) + " on");
  read_ = 0;
  follows_on_ = part.follows_on && missing_frames_ == 0;
  return true;
}

std::optional<Piece> SequenceReader::next() {
  while (true) {
    if (!file_ && !open_next()) return std::nullopt;
    const Part& part = sequence_->parts()[part_];
    const std::uint64_t left = part.frames - read_;
    const std::size_t room = static_cast<std::size_t>(std::min<std::uint64_t>(left, kPieceFrames));
    const std::size_t frames = room == 0 ? 0 : file_->read(std::span(interleaved_).first(room * part.format.channels));
    if (frames == 0) {
      missing_frames_ += left;
      if (!open_next()) return std::nullopt;
      continue;
    }
    for (std::size_t i = 0; i < frames; ++i) samples_[i] = scale_ * interleaved_[i * part.format.channels + channel_];
    const Piece piece{
        .begin = part.begin + read_, .part = part_, .follows_on = read_ > 0 || follows_on_, .samples = std::span(samples_).first(frames)};
    read_ += frames;
    return piece;
  }
}

}  // namespace earshot::recording
