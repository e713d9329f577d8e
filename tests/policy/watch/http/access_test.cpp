// GIVEN requests of browsers, of other people's pages in them, and of programs, WHEN they come, THEN those alone are answered that may
// read.

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "policy/watch/http/access.hpp"
#include "policy/watch/http/page_policy.hpp"
#include "policy/watch/http/request_head.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::watch {
namespace {

Asked usual() {
  return {.method = "GET",
          .path = "/events",
          .host = "127.0.0.1:8020",
          .origin = "",
          .fetch_site = "same-origin",
          .authorization = "",
          .address = "127.0.0.1"};
}

int status(const Asked& asked, const std::optional<Password>& password = std::nullopt) {
  const std::optional<Refusal> refusal = Access(password).refusal_of(asked);
  return refusal ? refusal->status : 200;
}

TEST(Access, IsForLoopbackAndTheAddressThatWasAskedAlone) {
  for (const char* host : {"127.0.0.1:8020", "127.0.0.1", "localhost:9", "[::1]:8020"}) {
    Asked asked = usual();
    asked.host = host;
    EXPECT_EQ(status(asked), 200) << host;
  }
  // A name of somebody else's that stands for 127.0.0.1 for the moment (DNS rebinding); another address; none.
  for (const char* host : {"evil.example:8020", "127.0.0.1.evil.example", "localhost.evil.example:8020", "192.168.2.7:8020", "", ":8020"}) {
    Asked asked = usual();
    asked.host = host;
    EXPECT_EQ(status(asked), 421) << host;
  }
  Asked elsewhere = usual();
  elsewhere.address = "192.168.2.7";
  elsewhere.host = "192.168.2.7:8020";
  EXPECT_EQ(status(elsewhere), 200);
}

TEST(Access, IsToReadAlone) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT", "get", ""}) {
    Asked asked = usual();
    asked.method = method;
    EXPECT_EQ(status(asked), 405) << method;
  }
  Asked head = usual();
  head.method = "HEAD";
  EXPECT_EQ(status(head), 200);
}

TEST(Access, IsToThePageAndItsEvents) {
  for (const char* path :
       {"/../../etc/passwd", "/%2e%2e/etc/passwd", "//events", "/events/", "/index.html", "", "/events/../..", "http://evil/"}) {
    Asked asked = usual();
    asked.path = path;
    EXPECT_EQ(status(asked), 404) << path;
  }
}

TEST(Access, IsNotForAnotherPageInTheSameBrowser) {
  for (const char* site : {"cross-site", "same-site"}) {
    Asked asked = usual();
    asked.fetch_site = site;
    EXPECT_EQ(status(asked), 403) << site;
  }
  for (const char* origin :
       {"http://evil.example", "null", "https://127.0.0.1:8020", "http://127.0.0.1:80", "http://127.0.0.1:8020.evil.example"}) {
    Asked asked = usual();
    asked.origin = origin;
    EXPECT_EQ(status(asked), 403) << origin;
  }
  Asked own = usual();
  own.origin = "http://127.0.0.1:8020";
  EXPECT_EQ(status(own), 200);
  own.fetch_site = "";  // an old browser
  EXPECT_EQ(status(own), 200);
}

TEST(Access, NeedsThePasswordWhereThereIsOne) {
  const Password password("open sesame");
  Asked asked = usual();
  EXPECT_EQ(status(asked, password), 401);
  asked.authorization = "Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ==";  // RFC 7617, section 2: Aladdin, open sesame
  EXPECT_EQ(status(asked, password), 200);
  asked.path = "/";
  asked.authorization = "";
  EXPECT_EQ(status(asked, password), 401);
}

TEST(Password, IsReadOfAnAuthorizationWithAnyUser) {
  const Password password("123\xC2\xA3");  // RFC 7617, section 2.1: test, 123 and the pound sign in UTF-8
  EXPECT_TRUE(password.is_in("Basic dGVzdDoxMjPCow=="));
  EXPECT_TRUE(password.is_in("Basic OjEyM8Kj")) << "no user (base64 of GNU coreutils)";
  for (const char* other : {"Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ==", "Bearer dGVzdDoxMjPCow==", "dGVzdDoxMjPCow==", "Basic dGVzdDoxMjPCow",
                            "Basic ", "", "Basic MTIzwqM=", "Basic \xFF", "Basic dGVzdDoxMjPCow==x"})
    EXPECT_FALSE(password.is_in(other)) << other;
}

TEST(Password, StandsInAFileThatNobodyElseMayRead) {
  const support::TemporaryFolder folder;
  const auto complaint = [&](const std::string& text, bool is_open) -> std::string {
    support::write_secret_file(folder / "password", text);
    if (is_open) std::filesystem::permissions(folder / "password", std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    try {
      return Password::of_file(folder / "password").is_in("Basic dXNlcjpjb3JyZWN0IGhvcnNl") ? "" : "another";  // user:correct horse
    } catch (const host::BadInput& e) {
      return e.what();
    }
  };
  EXPECT_EQ(complaint("correct horse\n", false), "");
  EXPECT_EQ(complaint("correct horse\r\nbattery staple\n", false), "");
  EXPECT_NE(complaint("correct horse\n", true).find("chmod 600"), std::string::npos);
  EXPECT_NE(complaint("elevenchars\n", false).find("at least 12"), std::string::npos);
  EXPECT_NE(complaint("", false).find("at least 12"), std::string::npos);
  EXPECT_NE(complaint(std::string(2000, 'x'), false).find("password"), std::string::npos);
}

TEST(RequestHead, KeepsTheLineAndTheHeadersThatDecideAlone) {
  EXPECT_EQ(needed_of_head("GET / HTTP/1.1\r\nhost: a\r\nRange: bytes=0-,0-\r\nAccept-Encoding: br\r\nORIGIN: b\r\nContent-Length: 7\r\n"
                           "Sec-Fetch-Site: none\r\nExpect: 100-continue\r\nAuthorization: Basic c\r\n\r\n"),
            "GET / HTTP/1.1\r\nhost: a\r\nORIGIN: b\r\nSec-Fetch-Site: none\r\nAuthorization: Basic c\r\n\r\n");
  EXPECT_EQ(needed_of_head("\r\n\r\n"), "\r\n");
}

TEST(PagePolicy, NamesTheScriptsThatAreItsOwn) {
  // Content Security Policy Level 3, section 8.5 names this script and its checksum.
  EXPECT_NE(content_security_policy("<p><script type=\"module\">alert('Hello, world.');</script>")
                .find("script-src 'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=';"),
            std::string::npos);
  EXPECT_NE(content_security_policy("<p>no script").find("default-src 'none'; script-src 'none';"), std::string::npos);
  EXPECT_NE(content_security_policy("<script>a").find("script-src 'none';"), std::string::npos) << "one that does not end";
}

}  // namespace
}  // namespace earshot::watch
