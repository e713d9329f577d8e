#include <optional>
#include <ostream>

#include "firmware/host/file/output_file.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/field/modes.hpp"
#include "sim/field_library/library.hpp"
#include "sim/field_library/plan.hpp"

namespace earshot::field {
namespace {

void print_summary(const FieldArguments& arguments, const field_library::LibraryPlan& plan, const field_library::LibrarySummary& summary,
                   std::size_t ranks, std::size_t threads) {
  const sonar::RadialPlan& radial = plan.fan.radial;
  program::print() << "library: " << plan.name << ": " << plan.positions.size() << " positions x " << plan.fan.bearings << " bearings x "
                   << radial.ranges << " ranges x " << radial.depth_m.size() << " depths\n"
                   << "fields:  " << summary.computed << " computed";
  if (summary.found > 0) program::print() << ", " << summary.found << " found from before";
  if (summary.without_water > 0) program::print() << ", " << summary.without_water << " on land or too shallow";
  if (!sonar::differs_with_place(plan.environment)) program::print() << "; one march for all: this ocean is the same everywhere";
  program::print() << "; " << host::counted(ranks, "process", "processes") << " of " << threads << " threads\n"
                   << "written: " << arguments.output << '\n';
  warn(field_library::unmeasured_water(plan));
}

}  // namespace

void write_library(const FieldArguments& arguments, parallel::RankSession& session) {
  std::optional<field_library::LibraryPlan> plan;
  session.all_or_none<BadStart, std::exception>([&] {
    plan = field_library::load_library_plan(arguments.library, environment_in);
    if (session.ranks().rank() == 0) require_writable(arguments, plan->environment);
  });

  const std::size_t threads = arguments.threads.value_or(session.processors());
  const auto summary = [&] {
    program::ProgressBar bar("library");
    return field_library::write_library(host::followed(arguments.output), *plan, threads, session.ranks(),
                                        [&bar](double fraction) { bar.update(fraction); });
  }();
  if (session.ranks().rank() == 0) print_summary(arguments, *plan, summary, session.ranks().size(), threads);
}

}  // namespace earshot::field
