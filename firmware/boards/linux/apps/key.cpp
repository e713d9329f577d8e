// earshot key: a pair of Ed25519 keys in two files.

#include <filesystem>

#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/trust/key_pair.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line("earshot key", "Makes a pair of keys: a secret one that signs, and a public one, which a vehicle trusts.");
  line.footer("Example: earshot key ops.key    (the public half: ops.pub)");
  std::filesystem::path file;
  line.option("FILE", &file, "secret key to make; its public half stands beside it as .pub; neither is ever replaced").required();
  return program::run(line, argc, argv, [&] {
    (void)host::make_key_pair(file, host::LonePublicHalf::kStays);
    program::print() << file.string() << " (secret: keep it), " << host::public_file_of(file).string() << " (a vehicle trusts it)\n";
    return program::kDone;
  });
}
