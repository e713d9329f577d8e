#include "policy/report/page/page_template.hpp"

#include <sodium.h>
#include <zlib.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

// The built page's bytes. `.incbin` is of the assembler's, not of the compiler's: large bytes in C++ take minutes to compile.
asm(".section .rodata\n"
    ".global earshot_page_begin\n.global earshot_page_end\n"
    "earshot_page_begin:\n.incbin \"" EARSHOT_PAGE_FILE "\"\nearshot_page_end:\n.byte 0\n.previous\n");
extern "C" {
extern const char earshot_page_begin[];  // NOLINT: of an unknown size
extern const char earshot_page_end[];    // NOLINT
}

namespace earshot::report {
namespace {

constexpr std::string_view kPlace = "<!--flight-->";
constexpr std::size_t kLong_bytes = 200'000;

/// No text of it ends a script, or begins a comment in one.
std::string escaped(std::string_view json) {
  std::string text;
  for (const char letter : json) {
    if (letter == '<')
      text += "\\u003c";
    else
      text += letter;
  }
  return text;
}

std::vector<std::uint8_t> compressed(std::string_view text) {
  constexpr int kGzip = 16;  // added to the size of the window: a gzip header instead of zlib's
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib: no memory");
  std::vector<std::uint8_t> packed(deflateBound(&stream, text.size()));
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));  // NOLINT: zlib does not change it
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib: the page cannot be compressed");
  return packed;
}

const char* id_of(PageOf what) {
  switch (what) {
    case PageOf::kFlight:
      return "flight";
    case PageOf::kSuite:
      return "suite";
    case PageOf::kBench:
      break;
  }
  return "bench";
}

}  // namespace

std::string_view page_template() {
  return {earshot_page_begin, earshot_page_end};
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // its zero
  return text;
}

std::string page_with(std::string_view json, PageOf what) {
  const std::string_view page = page_template();
  const std::size_t place = page.find(kPlace);
  const bool is_long = json.size() > kLong_bytes;
  std::string text(page.substr(0, place));
  text += std::string("<script id=\"") + id_of(what) + "\" type=\"application/" + (is_long ? "gzip" : "json") + "\">";
  text += is_long ? base64(compressed(json)) : escaped(json);
  text += "</script>";
  return text += page.substr(place + kPlace.size());
}

}  // namespace earshot::report
