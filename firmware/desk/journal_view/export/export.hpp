#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/journal/reading/entry.hpp"

namespace earshot::journal {

/// A file made of a journal's entries.
class Export {
 public:
  Export() = default;
  virtual ~Export() = default;
  Export(const Export&) = delete;
  Export& operator=(const Export&) = delete;

  /// @param events  what happened with this entry. @throws host::BadInput naming the file, such as on a full disk
  virtual void take(const Entry& entry, std::span<const Event> events) = 0;
  /// Gives the file its name; without it nothing is left. @param events  of the journal's end. @throws likewise
  virtual void finish(std::span<const Event> events) = 0;
  /// "1234 turns"
  [[nodiscard]] virtual std::string what() const = 0;
};

/// An OutputFile that is written in large pieces.
class PiecewiseFile {
 public:
  explicit PiecewiseFile(const std::filesystem::path& path) : file_(path) {}
  void write(std::string_view text) {
    constexpr std::size_t kPiece_bytes = 65'536;
    waiting_ += text;
    if (waiting_.size() >= kPiece_bytes) flush();
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write(waiting_);
    waiting_.clear();
  }

  host::OutputFile file_;
  std::string waiting_;
};

}  // namespace earshot::journal
