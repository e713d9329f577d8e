#include "policy/watch/http/page_policy.hpp"

#include <sodium.h>

#include <array>

#include "firmware/host/trust/keys.hpp"

namespace earshot::watch {
namespace {

std::string checksum_source(std::string_view script) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> checksum{};
  crypto_hash_sha256(checksum.data(), reinterpret_cast<const unsigned char*>(script.data()), script.size());
  std::string text(sodium_base64_ENCODED_LEN(checksum.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), checksum.data(), checksum.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // the zero that ends it
  return " 'sha256-" + text + "'";
}

}  // namespace

std::string content_security_policy(std::string_view page) {
  host::ready_libsodium();
  std::string scripts;
  for (std::size_t begin = 0; (begin = page.find("<script", begin)) != std::string_view::npos;) {
    const std::size_t from = page.find('>', begin);
    const std::size_t to = page.find("</script>", begin);
    if (from == std::string_view::npos || to == std::string_view::npos || to < from) break;
    scripts += checksum_source(page.substr(from + 1, to - from - 1));
    begin = to;
  }
  return "default-src 'none'; script-src" + (scripts.empty() ? " 'none'" : scripts) +
         "; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'";
}

}  // namespace earshot::watch
