// GIVEN a server and the Internet's worst browsers, WHEN they ask, wait, or stop in the middle, THEN the others are served, and it holds no
// more threads and memory than it may.

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "policy/watch/http/access.hpp"
#include "policy/watch/http/server.hpp"
#include "tests/policy/watch/http/client.hpp"

namespace earshot::watch {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

Frame event(const std::string& text) {
  return std::make_shared<const std::string>("data: " + text + "\n\n");
}

/// A line of /proc/self/status: "VmRSS", "Threads".
long of_process(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
  return -1;
}

class WatchServer : public ::testing::Test {
 protected:
  [[nodiscard]] std::uint16_t port() const { return port_in(server_.url()); }
  /// Waits until so many browsers look on.
  [[nodiscard]] bool has(std::size_t browsers) const {
    for (int i = 0; i < 200 && audience_.size() != browsers; ++i) std::this_thread::sleep_for(50ms);
    return audience_.size() == browsers;
  }
  /// One that asked for the events, and was promised them.
  std::unique_ptr<Client> looker(int receive_buffer_bytes = 0) const {
    auto client = std::make_unique<Client>(port(), receive_buffer_bytes);
    client->send(request("GET /events"));
    EXPECT_EQ(status_of(client->read_until("\r\n\r\n")), 200);
    EXPECT_EQ(client->read_until("\n\n"), "retry: 1000\n\n");
    return client;
  }

  static constexpr std::string_view kPage = "<!doctype html><title>Flight</title>";
  Audience audience_;
  Server server_{ServerSettings{.port = 0, .page = kPage}, audience_};
};

TEST_F(WatchServer, ServesThePageWithHeadersThatKeepOthersOut) {
  const std::string text = answer(port(), request("GET /"));
  EXPECT_EQ(status_of(text), 200);
  EXPECT_TRUE(text.ends_with("\r\n\r\n" + std::string(kPage))) << text;
  for (const char* header :
       {"Content-Type: text/html; charset=utf-8\r\n", "Cache-Control: no-store\r\n", "X-Content-Type-Options: nosniff\r\n",
        "X-Frame-Options: DENY\r\n", "Referrer-Policy: no-referrer\r\n", "Content-Security-Policy: default-src 'none'; ",
        "frame-ancestors 'none'\r\n", "Connection: close\r\n", "Cross-Origin-Resource-Policy: same-origin\r\n"})
    EXPECT_NE(text.find(header), std::string::npos) << header << text;
  EXPECT_EQ(text.find("Access-Control"), std::string::npos);
  const std::string head = answer(port(), request("HEAD /"));
  EXPECT_TRUE(head.ends_with("\r\n\r\n")) << head;
  EXPECT_NE(head.find("Content-Length: " + std::to_string(kPage.size()) + "\r\n"), std::string::npos) << head;
  EXPECT_TRUE(answer(port(), request("HEAD /events")).ends_with("\r\n\r\n"));
}

TEST_F(WatchServer, StreamsEventsAsTheyCome) {
  const auto client = looker();
  ASSERT_TRUE(has(1));
  audience_.give(event("whole"));
  EXPECT_EQ(client->read_until("\n\n"), "data: whole\n\n");
  audience_.publish(event("news"));
  EXPECT_EQ(client->read_until("\n\n"), "data: news\n\n");
}

TEST_F(WatchServer, RefusesWhatIsNotToBeRead) {
  EXPECT_EQ(status_of(answer(port(), request("GET /../../../../etc/passwd"))), 404);
  EXPECT_EQ(status_of(answer(port(), request("GET /%2e%2e/%2e%2e/etc/passwd"))), 404);
  EXPECT_EQ(status_of(answer(port(), request("GET /", "", "evil.example"))), 421);
  EXPECT_EQ(status_of(answer(port(), "GET / HTTP/1.1\r\n\r\n")), 421);
  EXPECT_EQ(status_of(answer(port(), "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nHost: evil.example\r\n\r\n")), 421);
  EXPECT_EQ(status_of(answer(port(), request("GET /events", "Origin: http://evil.example\r\n"))), 403);
  EXPECT_EQ(status_of(answer(port(), request("GET /events", "Sec-Fetch-Site: cross-site\r\n"))), 403);
  const std::string post = answer(port(), request("POST /", "Content-Length: 5\r\n") + "hello");
  EXPECT_EQ(status_of(post), 405);
  EXPECT_NE(post.find("Allow: GET, HEAD\r\n"), std::string::npos);
  EXPECT_EQ(status_of(answer(port(), "nonsense\r\n\r\n")), 400);
  EXPECT_EQ(status_of(answer(port(), request("GET /", "Range: bytes=0-,0-,0-\r\n"))), 200);
}

TEST_F(WatchServer, TakesNoMoreOfARequestThanItNeeds) {
  EXPECT_EQ(status_of(answer(port(), request("GET /", "A: " + std::string(64 << 10, 'x') + "\r\n"))), 431);
  const long before_kb = of_process("VmRSS");
  {
    Client client(port());
    client.send("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100000000\r\n\r\n");
    const std::string megabyte(1 << 20, 'x');
    for (int i = 0; i < 100 && client.send(megabyte); ++i) {
    }
    Client header(port());
    header.send("GET / HTTP/1.1\r\nA: ");
    for (int i = 0; i < 100 && header.send(megabyte); ++i) {
    }
  }
  EXPECT_LT(of_process("VmRSS") - before_kb, 20'000) << "of 200 MB that it was sent";
  EXPECT_EQ(status_of(answer(port(), request("GET /"))), 200);
}

TEST_F(WatchServer, GivesUpARequestThatDoesNotCome) {
  Client client(port());
  client.send("GET / HT");
  const auto began = steady_clock::now();
  EXPECT_EQ(status_of(client.read_all()), 408);
  EXPECT_GE(steady_clock::now() - began, 4s);
}

TEST_F(WatchServer, LosesNothingForOthersWhereOneNeverReads) {
  const auto stuck = looker(4096);
  const auto reader = looker();
  ASSERT_TRUE(has(2));
  audience_.give(event("whole"));
  EXPECT_EQ(reader->read_until("\n\n"), "data: whole\n\n");
  const Frame large = event(std::string(100'000, 'x'));
  auto longest = steady_clock::duration::zero();
  for (int i = 0; i < 200; ++i) {
    const auto began = steady_clock::now();
    audience_.publish(large);
    longest = std::max(longest, steady_clock::now() - began);
    ASSERT_EQ(reader->read_until("\n\n").size(), large->size()) << i;
  }
  EXPECT_LT(longest, 50ms) << "who publishes waits for nobody";
  EXPECT_GT(audience_.dropped_frames(), 0U);
  // It reads on: what was on its way, and then the whole again.
  for (int i = 0; i < 200 && !audience_.asks(); ++i) stuck->read_until("\n\n", 50ms);
  EXPECT_TRUE(audience_.asks());
  audience_.give(event("whole again"));
  EXPECT_TRUE(stuck->read_until("data: whole again\n\n").ends_with("data: whole again\n\n"));
}

TEST_F(WatchServer, HasAPlaceAgainWhereABrowserWentAway) {
  std::vector<std::unique_ptr<Client>> lookers;
  for (std::size_t i = 0; i < Audience::kMostBrowsers; ++i) lookers.push_back(looker());
  EXPECT_EQ(status_of(answer(port(), request("GET /events"))), 503);
  EXPECT_EQ(status_of(answer(port(), request("GET /"))), 200);
  lookers.pop_back();
  EXPECT_TRUE(has(Audience::kMostBrowsers - 1));
  lookers.push_back(looker());
}

TEST_F(WatchServer, HoldsTenThousandConnectionsOff) {
  const auto reader = looker();
  ASSERT_TRUE(has(1));
  audience_.give(event("whole"));
  EXPECT_EQ(reader->read_until("\n\n"), "data: whole\n\n");
  const long before_kb = of_process("VmRSS");
  std::vector<std::unique_ptr<Client>> idle;
  for (int i = 0; i < 10'000; ++i) {
    idle.push_back(std::make_unique<Client>(port()));
    if (idle.size() == 500) idle.erase(idle.begin(), idle.begin() + 250);
    if (i % 1000 != 0) continue;
    audience_.publish(event("news"));
    EXPECT_EQ(reader->read_until("\n\n", 1s), "data: news\n\n") << "after " << i;
  }
  EXPECT_LE(of_process("Threads"), static_cast<long>(Server::kMostThreads) + 3);
  EXPECT_LT(of_process("VmRSS") - before_kb, 20'000);
  idle.clear();
  EXPECT_EQ(status_of(answer(port(), request("GET /"))), 200);
}

TEST_F(WatchServer, EndsThoughBrowsersWait) {
  Audience audience;
  auto server = std::make_unique<Server>(ServerSettings{.port = 0, .page = kPage}, audience);
  Client waiting(port_in(server->url()));
  waiting.send(request("GET /events"));
  waiting.read_until("retry");
  Client idle(port_in(server->url()));
  const auto began = steady_clock::now();
  server.reset();
  EXPECT_LT(steady_clock::now() - began, 2s);
  waiting.read_all();
  EXPECT_TRUE(waiting.is_closed());
}

TEST_F(WatchServer, SharesNoPort) {
  Audience audience;
  EXPECT_THROW(Server(ServerSettings{.port = port(), .page = kPage}, audience), PortTaken);
  EXPECT_THROW(Server(ServerSettings{.address = "203.0.113.1", .port = 0, .page = kPage}, audience), host::BadInput);
}

TEST_F(WatchServer, AsksForThePasswordBeforeAnythingElse) {
  Audience audience;
  const Server server(ServerSettings{.port = 0, .password = Password("open sesame"), .page = kPage}, audience);
  const std::uint16_t port = port_in(server.url());
  const std::string refused = answer(port, request("GET /"));
  EXPECT_EQ(status_of(refused), 401);
  EXPECT_NE(refused.find("WWW-Authenticate: Basic realm=\"Earshot\", charset=\"UTF-8\"\r\n"), std::string::npos);
  EXPECT_EQ(refused.find("Flight"), std::string::npos);
  EXPECT_EQ(status_of(answer(port, request("GET /events"))), 401);
  EXPECT_EQ(status_of(answer(port, request("GET /", "Authorization: Basic dGVzdDoxMjPCow==\r\n"))), 401);
  EXPECT_EQ(status_of(answer(port, request("GET /", "Authorization: Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ==\r\n"))), 200);  // RFC 7617
}

TEST_F(WatchServer, AnswersToTheAddressThatItWasAskedAt) {
  Audience audience;
  const Server server(ServerSettings{.address = "0.0.0.0", .port = 0, .page = kPage}, audience);
  const std::uint16_t port = port_in(server.url());
  Client client(port, 0, "127.0.0.2");
  client.send(request("GET /", "", "127.0.0.2:1"));
  EXPECT_EQ(status_of(client.read_all()), 200);
  EXPECT_EQ(status_of(answer(port, request("GET /", "", "127.0.0.2"))), 421) << "it came to 127.0.0.1";
  EXPECT_TRUE(is_address("::1") && is_address("192.168.2.7"));
  EXPECT_FALSE(is_address("localhost") || is_address("vehicle.example") || is_address(""));
}

}  // namespace
}  // namespace earshot::watch
