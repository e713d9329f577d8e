#pragma once

#include <dds/dds.h>

#include <atomic>
#include <cstdint>
#include <string>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"
#include "sim/link/session.hpp"

namespace earshot::link {

// Inside of the two ends of the link; nobody else needs Cyclone DDS.

/// Every topic: reliable, volatile, KEEP_LAST 16 (KEEP_ALL may block its writer; in lock-step one sample is under way).
[[nodiscard]] dds_entity_t make_writer(const Session& session, const dds_topic_descriptor_t& type);
[[nodiscard]] dds_entity_t make_reader(const Session& session, const dds_topic_descriptor_t& type, dds_listener_t* listener);

/// Throws LinkError when the write failed.
void write(dds_entity_t writer, const void* sample, const char* what);

/// Puts everything that the peer sends into a mailbox of `Message`, and closes the mailbox when the peer is gone.
/// `convert` turns a `Sample` into a message. Runs on Cyclone's threads, so that no further thread must be woken on the way.
///
/// The peer is the first writer of a sample of `run`; where the run is not known, the first writer of a sample with number 0. Samples of
/// all others in the domain are counted and ignored.
template <class Sample, class Message, Message (*convert)(const Sample&)>
class Delivering {
 public:
  Delivering(const Session& session, const dds_topic_descriptor_t& type, Mailbox<Message>& mailbox, RunId run)
      : mailbox_(mailbox), run_(run) {
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, [](dds_entity_t reader, void* self) { static_cast<Delivering*>(self)->deliver(reader); });
    dds_lset_subscription_matched(listener, [](dds_entity_t, const dds_subscription_matched_status_t status, void* self) {
      static_cast<Delivering*>(self)->note_writers(status);
    });
    reader_ = make_reader(session, type, listener);
    dds_delete_listener(listener);
  }
  /// No thread of Cyclone's is in here afterwards.
  ~Delivering() { dds_delete(reader_); }
  Delivering(const Delivering&) = delete;
  Delivering& operator=(const Delivering&) = delete;

  /// Of the peer; 0 as long as that is not known.
  [[nodiscard]] RunId run() const { return run_; }
  /// Samples of others that were ignored.
  [[nodiscard]] std::uint64_t strangers() const { return strangers_; }

 private:
  void deliver(dds_entity_t reader) {
    Sample sample{};
    void* samples[1] = {&sample};
    dds_sample_info_t info{};
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      if (!info.valid_data) continue;
      if (is_of_peer(sample, info.publication_handle)) {
        mailbox_.put(convert(sample));
      } else {
        ++strangers_;
      }
    }
  }

  [[nodiscard]] bool is_of_peer(const Sample& sample, dds_instance_handle_t writer) {
    if (peer_ != 0) return writer == peer_ && sample.run == run_;
    if (run_ == 0 && sample.number == 0) run_ = sample.run;
    if (run_ == 0 || sample.run != run_) return false;
    peer_ = writer;
    return true;
  }

  void note_writers(const dds_subscription_matched_status_t& status) {
    if (status.current_count_change < 0 && status.last_publication_handle == peer_) mailbox_.close();
  }

  Mailbox<Message>& mailbox_;
  std::atomic<RunId> run_;
  std::atomic<dds_instance_handle_t> peer_{0};
  std::atomic<std::uint64_t> strangers_{0};
  dds_entity_t reader_ = 0;
};

}  // namespace earshot::link
