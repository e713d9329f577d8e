#pragma once

#include <dds/dds.h>

#include <chrono>
#include <string>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"
#include "sim/link/session.hpp"

namespace earshot::link {

// Inside of the two ends of the link; nobody else needs Cyclone DDS.

/// Every topic: reliable, volatile, KEEP_LAST 16 (KEEP_ALL may block its writer; in lock-step one sample is under way).
[[nodiscard]] dds_entity_t make_writer(const Session& session, const dds_topic_descriptor_t& type);
[[nodiscard]] dds_entity_t make_reader(const Session& session, const dds_topic_descriptor_t& type, dds_listener_t* listener);

/// Waits until `writer` has a reader.
[[nodiscard]] bool wait_for_reader(dds_entity_t writer, std::chrono::milliseconds timeout);

/// Throws LinkError when the write failed.
void write(dds_entity_t writer, const void* sample, const char* what);

/// Puts everything that arrives for a reader of `Sample` into a mailbox of `Message`, and closes the mailbox when the writer is gone.
/// `convert` turns one into the other. Runs on Cyclone's receive thread, so that no further thread must be woken on the way.
template <class Sample, class Message, Message (*convert)(const Sample&)>
class Delivering {
 public:
  Delivering(const Session& session, const dds_topic_descriptor_t& type, Mailbox<Message>& mailbox) {
    dds_listener_t* listener = dds_create_listener(&mailbox);
    dds_lset_data_available(listener, &deliver);
    dds_lset_subscription_matched(listener, &note_writers);
    reader_ = make_reader(session, type, listener);
    dds_delete_listener(listener);
  }

 private:
  static void deliver(dds_entity_t reader, void* argument) {
    Sample sample{};
    void* samples[1] = {&sample};
    dds_sample_info_t info{};
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      if (info.valid_data) static_cast<Mailbox<Message>*>(argument)->put(convert(sample));
    }
  }

  static void note_writers(dds_entity_t /*reader*/, const dds_subscription_matched_status_t status, void* argument) {
    if (status.current_count == 0) static_cast<Mailbox<Message>*>(argument)->close();
  }

  dds_entity_t reader_ = 0;  ///< owned by the session's participant
};

}  // namespace earshot::link
