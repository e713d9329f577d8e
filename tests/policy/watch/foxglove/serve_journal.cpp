// serve_journal JOURNAL: prints the port of a FoxgloveServer, and publishes the whole journal once for each line of standard input.

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/desk/journal_view/export/topic_messages.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "policy/watch/foxglove/foxglove_server.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  if (argc != 2) return 2;
  journal::TopicMessages messages(n2k::LocalPlane{});
  watch::FoxgloveServer server(0);
  std::cout << server.port() << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    journal::RecordSource source(argv[1], host::Accepts::kBusLogs);
    journal::Timeline timeline;
    while (const std::optional<journal::Entry> entry = source.next()) server.publish(messages.of(*entry, timeline.take(*entry)));
    std::cout << "published" << std::endl;
  }
}
