#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/trust/key_pair.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/envelope/envelope.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/run.hpp"
#include "policy/command_line/signing_key.hpp"
#include "policy/tables/believed_ocean.hpp"
#include "policy/tables/curves_plot.hpp"
#include "policy/tables/description.hpp"
#include "policy/tables/expected.hpp"
#include "policy/tables/make_tables.hpp"
#include "policy/tables/ocean_curve.hpp"
#include "policy/tables/signed_tables.hpp"
#include "sim/search/settings.hpp"

namespace {

using namespace earshot;
using host::BadInput;

struct Options {
  std::vector<std::string> environments;
  std::vector<std::string> expected;
  std::vector<std::string> variants;
  std::optional<std::string> origin;
  std::optional<std::string> output;
  std::optional<std::string> show;
  std::optional<std::string> plot;
  command_line::SigningKeyOptions key;
  double vehicle_depth_m = 300.0;
  std::optional<double> furthest_m;
  double range_step_m = 100.0;
  std::uint32_t bearings = 8;
  std::uint32_t at_most = config::kMaxOceanTables;
  bool force = false;
};

/// The diagonal of the paper's area.
Meters usual_furthest() {
  const search::SearchSettings settings;
  return range_between(settings.domain.south_west, settings.domain.north_east);
}

void add_options(program::CommandLine& line, Options& o) {
  line.option(
      "ENVIRONMENT", &o.environments,
      "environment files (TOML), or folders of them: oceans believed possible, each with its [[oceans]], [family] or [field_library]");
  line.option("--expected", &o.expected,
              "environment file that is the likeliest, or a folder of them; may be given several times: none of their oceans is merged "
              "with another, and all of them weigh as much as all of the others")
      .one_each_time();
  line.option("--variants", &o.variants,
              "environment file, or a folder of them, that differs from what is expected in one thing (policy/worlds/generate "
              "--variants-of writes them); may be given several times: none is merged either, and each weighs as much as one other table")
      .one_each_time();
  line.option("-o,--output", &o.output, "tables to write (.tables)");
  line.option("--show", &o.show, "print what these tables are (.tables), and make none");
  line.option("--plot", &o.plot, "also draw SNR against range in every ocean there (.png or .svg)");
  line.option("--vehicle-depth-m", &o.vehicle_depth_m, "depth of the vehicle, metres").shows_default().between(0.1, 12'000.0);
  line.option("--furthest-m", &o.furthest_m, "furthest that a source may be from the vehicle, metres (the diagonal of 25 km x 25 km)")
      .positive();
  line.option("--range-step-m", &o.range_step_m, "between two ranges of a table, metres").shows_default().between(1.0, 10'000.0);
  line.option("--bearings", &o.bearings, "how many bearings of an ocean that differs from one to another are tables of their own")
      .shows_default()
      .from(1, 360);
  line.option("--at-most", &o.at_most, "tables; of more oceans those that are most alike become one")
      .shows_default()
      .from(1, config::kMaxOceanTables);
  line.option("--origin", &o.origin, "where the environments come from, in words: the file states it");
  o.key.add_to(line);
  line.flag("--force", &o.force, command_line::kForceHelp);
  line.footer(
      "An ocean whose sea floor lies above the vehicle is left out, which is reported.\n"
      "Example: earshot tables sim/ocean/environments/munk_flat.toml -o mine.tables --key mine.key --new-key\n"
      "         earshot tables --show mine.tables --plot mine.png");
}

tables::CurvePlan plan_of(const Options& o) {
  const Meters furthest = o.furthest_m ? Meters{*o.furthest_m} : usual_furthest();
  const double ranges = tables::range_count(furthest, Meters{o.range_step_m});
  if (!(ranges <= static_cast<double>(config::kMaxTableRanges))) {
    const auto least_step = static_cast<long>(std::ceil(furthest.value / static_cast<double>(config::kMaxTableRanges - 1)));
    throw BadInput("--range-step-m, --furthest-m: give more than the " + std::to_string(config::kMaxTableRanges) +
                   " ranges that a vehicle holds; --range-step-m " + std::to_string(least_step) + " does not");
  }
  return {.vehicle_depth = Meters{o.vehicle_depth_m},
          .range_step = Meters{o.range_step_m},
          .range_count = static_cast<std::size_t>(ranges),
          .bearings = o.bearings};
}

/// What is read: the files of --expected and of --variants, and all others.
struct Files {
  std::vector<std::filesystem::path> expected;
  std::vector<std::filesystem::path> variants;
  std::vector<std::filesystem::path> others;
};

/// Those of some files that were not met before, each under whatever name; says which were.
std::vector<std::filesystem::path> new_ones_of(const std::vector<std::filesystem::path>& files, const char* kind,
                                               std::map<std::filesystem::path, std::string>& met) {
  std::vector<std::filesystem::path> new_ones;
  for (const std::filesystem::path& file : files) {
    std::error_code none;
    const auto [first, is_new] = met.emplace(std::filesystem::weakly_canonical(file, none), kind);
    if (is_new)
      new_ones.push_back(file);
    else
      program::print() << host::printable(file.string()) << ": given twice, counts once, as " << first->second << "\n";
  }
  return new_ones;
}

/// A folder may hold one that is expected, or a variant: it counts once.
Files files_of(const Options& o) {
  std::map<std::filesystem::path, std::string> met;
  Files files;
  files.expected = new_ones_of(tables::environment_files(o.expected), "expected", met);
  files.variants = new_ones_of(tables::environment_files(o.variants), "a variant", met);
  files.others = new_ones_of(tables::environment_files(o.environments), "one of the others", met);
  return files;
}

std::vector<tables::BelievedOcean> oceans_of(const std::vector<std::filesystem::path>& files) {
  std::vector<tables::BelievedOcean> oceans;
  for (const std::filesystem::path& file : files)
    for (tables::BelievedOcean& ocean : tables::oceans_in(file)) oceans.push_back(std::move(ocean));
  return oceans;
}

/// @param left_out  without water at the vehicle's depth, in words
std::vector<tables::OceanCurve> curves_of(const std::vector<tables::BelievedOcean>& oceans, const tables::CurvePlan& plan,
                                          std::vector<std::string>& left_out) {
  if (oceans.empty()) return {};
  program::ProgressBar bar("tables");
  return tables::curves_of(
      oceans, plan, [&bar](double share) { bar.update(share); },
      [&left_out](const tables::BelievedOcean& ocean) {
        left_out.push_back(ocean.file.string() + ": " + host::printable(ocean.environment.name));
      });
}

struct Oceans {
  std::vector<tables::BelievedOcean> expected;
  std::vector<tables::BelievedOcean> variants;
  std::vector<tables::BelievedOcean> others;
};

std::vector<tables::BelievedOcean> all_of(const Oceans& oceans) {
  std::vector<tables::BelievedOcean> all = oceans.expected;
  all.insert(all.end(), oceans.variants.begin(), oceans.variants.end());
  all.insert(all.end(), oceans.others.begin(), oceans.others.end());
  return all;
}

/// What is heard in them.
struct Curves {
  tables::Unmerged unmerged;
  std::vector<tables::OceanCurve> others;
};

Curves curves_of(const Oceans& oceans, const tables::CurvePlan& plan) {
  constexpr const char* kAbove = ": the sea floor lies above the vehicle";
  Curves curves;
  std::vector<std::string> left_out;
  curves.unmerged.expected = curves_of(oceans.expected, plan, left_out);
  if (!left_out.empty()) throw BadInput("--vehicle-depth-m: " + left_out.front() + kAbove + ", and the ocean is expected");
  curves.unmerged.variants = curves_of(oceans.variants, plan, left_out);
  curves.others = curves_of(oceans.others, plan, left_out);
  if (!oceans.others.empty() && curves.others.empty())
    throw BadInput("--vehicle-depth-m: " + left_out.front() + kAbove + ", as in every ocean given");
  for (const std::string& ocean : left_out) program::print() << ocean << ": left out, its sea floor lies above the vehicle\n";
  return curves;
}

/// Of all files that were read, in their order.
std::string checksum_of(const std::vector<tables::BelievedOcean>& oceans) {
  std::string checksums;
  for (const tables::BelievedOcean& ocean : oceans) checksums += host::crc32_text(ocean.environment.file_crc32);
  return host::crc32_text(host::crc32_of(checksums));
}

std::unique_ptr<policy::OceanTables> tables_of(const Files& files, const Oceans& oceans, const Options& o) {
  const tables::CurvePlan plan = plan_of(o);
  const std::vector<tables::BelievedOcean> every = all_of(oceans);
  tables::require_one_frequency(every);
  const Curves curves = curves_of(oceans, plan);
  std::vector<tables::OceanCurve> all = curves.unmerged.expected;
  all.insert(all.end(), curves.unmerged.variants.begin(), curves.unmerged.variants.end());
  all.insert(all.end(), curves.others.begin(), curves.others.end());
  const tables::Merged merged = tables::merge_beside(curves.unmerged, curves.others, o.at_most);
  if (merged.curves.size() < all.size())
    program::print() << all.size() << " curves became " << merged.curves.size() << " tables; none is further than "
                     << host::decimals(merged.most_difference_db, 1) << " dB rms from its own, where it is audible\n";
  const std::size_t environments = files.expected.size() + files.variants.size() + files.others.size();
  std::vector<std::pair<std::string, std::string>> provenance{{"made_by", "earshot tables " + program::version()},
                                                              {"commit", program::build_commit()},
                                                              {"environments", std::to_string(environments)},
                                                              {"environments_crc32", checksum_of(every)},
                                                              {"oceans", std::to_string(every.size())},
                                                              {"curves", std::to_string(all.size())},
                                                              {"expected", std::to_string(curves.unmerged.expected.size())},
                                                              {"variants", std::to_string(curves.unmerged.variants.size())},
                                                              {"merged_within_db", host::decimals(merged.most_difference_db, 1)}};
  if (o.origin) provenance.emplace_back("origin", *o.origin);
  return tables::make_tables(merged.curves, all, plan, every.front().environment.source.frequency, provenance);
}

/// Tables that are there are shown, not made.
void require_no_tables(const std::vector<std::string>& environments) {
  for (const std::string& file : environments) {
    if (std::filesystem::path(file).extension() == ".tables")
      throw BadInput("ENVIRONMENT " + file + ": is a file of tables, not an environment: earshot tables --show " + file +
                     " prints what is in it");
  }
}

/// @param read  none of which may be written: --force would replace it
void check_outputs(const Options& o, host::DistinctFiles read) {
  std::vector<host::Output> outputs;
  if (o.output) outputs.push_back({"--output", *o.output, command_line::kTablesOutput});
  if (o.plot) {
    command_line::check_picture_name("--plot", *o.plot);
    outputs.push_back({"--plot", *o.plot, host::picture_kind(*o.plot)});
  }
  if (!o.show) o.key.add_to(read);
  host::require_writable(std::move(read), outputs, host::replaced_by(o.force));
}

void show(const Options& o) {
  if (!o.environments.empty() || !o.expected.empty() || !o.variants.empty() || o.origin || o.output || !o.key.key.empty() ||
      o.key.only_makes_keys())
    throw BadInput("--show: goes with --plot alone, it makes no tables");
  host::DistinctFiles read;
  read.read("--show", *o.show);
  check_outputs(o, std::move(read));
  const std::vector<std::uint8_t> bytes = host::read_tables_bytes(*o.show);
  const std::unique_ptr<policy::OceanTables> tables = host::tables_from(bytes, *o.show);
  tables::describe(program::print(), *tables);
  const host::PublicKey key = policy::format::carried_key(bytes);
  program::print() << (host::is_signed_at_end(bytes, key) ? "signed with the secret half of " : "NOT signed with the secret half of ")
                   << host::to_text(key) << host::printable_lines({tables->provenance.begin(), tables->provenance.end()});
  if (o.plot) tables::plot_curves(*o.plot, *tables);
}

void make(const Options& o) {
  for (const auto* files : {&o.environments, &o.expected, &o.variants}) require_no_tables(*files);
  if (!o.variants.empty() && o.expected.empty()) throw BadInput("--variants: of what is expected; give --expected, too");
  if ((o.environments.empty() && o.expected.empty()) || !o.output || o.key.key.empty())
    throw BadInput("earshot tables: ENVIRONMENT or --expected, --output and --key are needed; or --show alone");
  const Files files = files_of(o);
  const Oceans oceans{.expected = oceans_of(files.expected), .variants = oceans_of(files.variants), .others = oceans_of(files.others)};
  host::DistinctFiles read;
  read.read("ENVIRONMENT", files.others);
  read.read("--expected", files.expected);
  read.read("--variants", files.variants);
  for (const tables::BelievedOcean& ocean : all_of(oceans)) read.read("a file of " + ocean.file.string() + ":", ocean.environment.files);
  check_outputs(o, std::move(read));
  program::print() << "oceans read: " << files.expected.size() << " expected (--expected), " << files.variants.size()
                   << " variants of these (--variants), " << files.others.size() << " others (ENVIRONMENT)\n";
  const std::unique_ptr<policy::OceanTables> tables = tables_of(files, oceans, o);
  const host::SecretKey key = o.key.read(o.force);
  const std::vector<std::uint8_t> bytes = tables::sign(*tables, key);
  host::write_whole(*o.output, std::string(bytes.begin(), bytes.end()));
  tables::describe(program::print(), *tables);
  if (o.plot) tables::plot_curves(*o.plot, *tables);
  program::detail() << o.key.key << ": signed with it; a vehicle trusts " << host::public_file_of(o.key.key).string() << "\n";
  program::print() << *o.output << ": " << bytes.size() << " bytes, " << host::counted(tables->tables.size(), "table") << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot tables",
                            "Makes the signed file of what a vehicle believes possible of the ocean, or prints what is in one.");
  Options options;
  add_options(line, options);
  return command_line::run(line, argc, argv, [&] { options.show ? show(options) : make(options); });
}
