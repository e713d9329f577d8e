#include "firmware/host/file/process_name.hpp"

#include <fstream>

namespace earshot::host {

std::string name_of_process(const std::string& number) {
  std::string name = "a program";
  std::ifstream comm("/proc/" + number + "/comm");
  std::getline(comm, name);
  return name + " (process " + number + ")";
}

}  // namespace earshot::host
