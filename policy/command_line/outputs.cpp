#include "policy/command_line/outputs.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::command_line {

void check_picture_name(const std::string& option, const std::filesystem::path& path) {
  if (!plot::is_picture_name(path)) throw host::BadInput(option + " " + path.string() + ": must end in .png or .svg");
}

}  // namespace earshot::command_line
