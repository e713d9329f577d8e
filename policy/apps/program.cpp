#include "policy/apps/program.hpp"

#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::apps {
namespace {

using host::BadInput;

void check_command_line(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (!host::is_utf8(argv[i])) throw BadInput("the command line holds bytes that are not UTF-8");
  }
}

/// One name for one file, whether it is there yet or not.
std::filesystem::path canonical_name(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

}  // namespace

int run_program(program::CommandLine& line, int argc, char** argv, const std::function<void()>& body) {
  return program::run(line, argc, argv, [&] {
    check_command_line(argc, argv);
    body();
    return program::kDone;
  });
}

int run_ranked_program(program::CommandLine& line, int argc, char** argv, const std::function<void(parallel::RankSession&)>& body) {
  try {
    parallel::RankSession session;
    if (session.ranks().rank() != 0) {
      std::cerr.rdbuf(nullptr);
      std::cout.rdbuf(nullptr);
    }
    return run_program(line, argc, argv, [&] { body(session); });
  } catch (const std::runtime_error& e) {
    std::cerr << line.name() << ": " << e.what() << "\n";
    return program::kBadInput;
  }
}

std::filesystem::path data_folder() {
  return host::shipped("policy");
}

std::filesystem::path shipped_policy() {
  return host::shipped("policy/frozen/shipped.policy");
}

void check_distinct(std::span<const Output> files) {
  std::map<std::filesystem::path, const Output*> known;
  for (const Output& file : files) {
    const auto [first, is_new] = known.emplace(canonical_name(file.path), &file);
    if (is_new) continue;
    const Output& other = *first->second;
    throw BadInput(other.option + " " + other.path.string() + ", " + file.option + " " + file.path.string() +
                   ": the same file, one would replace the other");
  }
}

void require_writable(std::span<const Output> files, host::Replace replace) {
  check_distinct(files);
  for (const Output& file : files) host::require_writable(file.path, file.kind, replace);
}

void tell_of_policy(const std::string& name, const policy::FrozenPolicy& policy) {
  std::ostream& out = program::detail();
  out << host::printable(name) << ": " << policy.observation.spec.size() << " observations, " << policy.actions.size()
      << " actions, steps of " << policy.step_length.value << " m in " << policy.area_size.north.value << " m x "
      << policy.area_size.east.value << " m\n";
  std::istringstream provenance(std::string(policy.provenance.begin(), policy.provenance.end()));
  for (std::string line; std::getline(provenance, line);) out << "  " << host::printable(line) << "\n";
}

policy::ActionDraw draw_named(std::string_view name) {
  return name == "argmax" ? policy::ActionDraw::kArgmax : policy::ActionDraw::kSampled;
}

void check_picture_name(const std::string& option, const std::filesystem::path& path) {
  if (!plot::is_picture_name(path)) throw BadInput(option + " " + path.string() + ": must end in .png or .svg");
}

}  // namespace earshot::apps
