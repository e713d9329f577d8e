#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "firmware/host/journal/reading/record_source.hpp"
#include "policy/watch/flight_source.hpp"

namespace earshot::watch {

/// A flight by its journal: one that is being written, that of `earshot fly` among them, or one that is over. Where a mission begins
/// beside it later, that takes its place.
/// Oracle: FollowedFlight.*
class FollowedFlight final : public FlightSource {
 public:
  /// @param folder_or_journal  as a person names it
  /// @param most_wait          nothing: what is there is shown, also a flight that is over. Else a mission that is under way, or that
  ///                           begins so soon
  /// @throws host::BadInput when nothing is there and none is to be waited for, or it is no journal
  FollowedFlight(std::filesystem::path folder_or_journal, std::optional<std::chrono::seconds> most_wait);

  [[nodiscard]] Change take() override;
  [[nodiscard]] report::GrowingFlight& flight() override { return *flight_; }
  void wait(std::chrono::milliseconds most) override;

 private:
  using Clock = std::chrono::steady_clock;
  /// Which file it is, whatever its name is by now.
  struct FileId {
    std::uint64_t device = 0;
    std::uint64_t number = 0;
    friend bool operator==(const FileId&, const FileId&) = default;
  };
  [[nodiscard]] static FileId id_of(const std::filesystem::path& file);

  void follow(report::FlightSurroundings surroundings);
  [[nodiscard]] Change take_more();
  [[nodiscard]] bool take_entries();
  /// For a mission that began, or for the files of the one that is over.
  [[nodiscard]] Change search();
  /// At the journal's end: nobody writes it any more.
  [[nodiscard]] bool is_left() const;
  /// A mission that began since. Nothing: none did.
  [[nodiscard]] std::optional<std::filesystem::path> next_journal() const;
  /// What a simulator leaves beside a journal stands there when its flight is over. @return whether it does now
  [[nodiscard]] bool take_files();

  std::filesystem::path asked_;
  std::optional<Clock::time_point> deadline_;  ///< of waiting for a mission
  FileId before_;                              ///< the newest journal when the waiting began
  std::unique_ptr<report::GrowingFlight> flight_;
  std::unique_ptr<journal::RecordSource> source_;  ///< nothing: it waits for a mission
  std::filesystem::path journal_;
  FileId id_;
  bool is_at_end_ = false;  ///< of what stands in the file by now
  bool has_ended_ = false;  ///< nobody writes it any more
  bool has_files_ = false;  ///< a simulator's were taken
  Clock::time_point last_growth_;
  Clock::time_point next_search_;
};

}  // namespace earshot::watch
