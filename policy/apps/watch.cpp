// earshot-watch: the page of a flight while it is flown.

#include "policy/watch/watch.hpp"
#include "firmware/host/program/run.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line("earshot watch",
                            "earshot watch PLACE shows a flight in a browser, while it is flown and afterwards. It prints the page's "
                            "address, and serves it until\n"
                            "Ctrl-C. It only reads: it commands nothing, and the vehicle does not know of it.\n"
                            "Exit status: 0 ended by Ctrl-C, 2 bad input, 3 the network was lost.");
  watch::WatchOptions options;
  line.option(
          "PLACE", &options.what,
          "journal of a flight (.lcmlog), its folder, or lcm: the messages of a vehicle on LCM. Of a folder the mission that is under way "
          "there, else the last that is over")
      .required();
  line.option("--wait", &options.wait_s, "seconds to wait for a mission that begins there; a flight that is over is not shown then")
      .from(0, 86'400);
  line.option("--lcm-url", &options.lcm_url, "LCM network of the vehicle, for lcm").shows_default();
  line.option("--port", &options.port, "TCP port; 0: one that is free; default: 8020, or one that is free where that is taken")
      .from(0, 65'535);
  line.option("--listen", &options.listen,
              "address of this computer where others may read, 0.0.0.0 for all that it has; needs --password-file; default: this computer "
              "alone");
  line.option("--password-file", &options.password_file,
              "file whose first line is the password that a browser asks for, with any user name; nobody else may read it");
  line.flag("--foxglove", &options.foxglove, "also serve Foxglove and Lichtblick, on this computer alone");
  line.option("--foxglove-port", &options.foxglove_port, "their TCP port; 0: one that is free").shows_default().from(0, 65'535);
  line.flag("--open", &options.open, "open it in a browser, where there is a desktop");
  line.footer(
      "Examples:\n"
      "  earshot watch out\n"
      "  earshot watch lcm --lcm-url 'udpm://239.255.76.67:7667?ttl=1'");
  return program::run(line, argc, argv, [&] { return watch::watch(options); });
}
