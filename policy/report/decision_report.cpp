#include "policy/report/decision_report.hpp"

#include "firmware/host/text/duration.hpp"
#include "policy/report/explanation.hpp"

namespace earshot::report {
namespace {

using explain::factor_to_string;
using explain::fixed;

constexpr std::size_t kRows = 8;  ///< of the observation, shown in a report

std::string subtitle(const DecisionReport& report) {
  const explain::RecordedDecision& d = report.account.decision;
  return host::duration(d.time_s() - report.measurements().front().time_s()) + " after the first decision, " +
         fixed(d.position.north.value / 1e3, 2) + " km north, " + fixed(d.position.east.value / 1e3, 2) + " km east. Journal " +
         report.flight.journal_path.string() + ", policy " + report.flight.policy_path.string() +
         ": replayed, and every decision up to the last comes out bit for bit.";
}

/// That nobody was at sea, and what was searched for, where, how and when.
std::string conditions_markdown(const DecisionReport& report) {
  const std::optional<Conditions>& conditions = report.flight.conditions;
  if (!conditions) return "";
  return (conditions->is_simulated ? std::string(kSimulationNote) + "\n\n" : "") + to_string(*conditions) + ".\n\n";
}

std::string notes(const DecisionReport& report) {
  return lack_of(report.flight.journal);
}

std::string choice_markdown(const explain::DecisionAccount& a) {
  std::string text = "\n" + actions_markdown(a);
  if (!has_network(a)) return text;
  text += "\n" + std::string(kPartsMean) + "\n\n| observation | seen | baseline | part | chance |\n|---|---|---|---|---|\n";
  for (const explain::ObservedAccount& o : explain::weightiest(a, kRows))
    text += "| " + o.name + " | " + o.value + " | " + o.baseline + " | " + fixed(o.part, 3) + " | " + factor_to_string(o.part) + " |\n";
  return text + "\nCompared with " + to_string(a.baseline) + ": " + completeness_to_string(a.attribution) + ".\n";
}

}  // namespace

DecisionReport make_decision_report(const RecordedFlight& flight, std::size_t index, explain::Baseline baseline) {
  const auto decisions = std::span(flight.journal.decisions).first(index + 1);
  return {.flight = flight, .index = index, .account = explain::account_of(flight.circumstances(baseline), decisions)};
}

std::string title_of(const DecisionReport& report) {
  const explain::DecisionAccount& a = report.account;
  return "Step " + std::to_string(a.decision.step) + (a.decision.sweeping ? ": a sweep, going " : ": why it went ") +
         a.actions[a.decision.action].name;
}

std::string as_markdown(const DecisionReport& report) {
  const explain::DecisionAccount& a = report.account;
  std::string text = "# " + title_of(report) + "\n" + subtitle(report) + "\n\n" + conditions_markdown(report);
  if (!notes(report).empty()) text += notes(report) + "\n\n";
  for (const std::string& sentence : sentences(a)) text += "- " + sentence + "\n";
  if (!a.decision.sweeping) text += choice_markdown(a);
  text += "\n| step | north (km) | east (km) | SNR |\n|---|---|---|---|\n";
  for (const explain::RecordedDecision& measurement : report.measurements())
    text += "| " + std::to_string(measurement.step) + " | " + fixed(measurement.position.north.value / 1e3, 2) + " | " +
            fixed(measurement.position.east.value / 1e3, 2) + " | " + to_string(measurement.reception()) +
            (measurement.detected ? ", a detection" : "") + " |\n";
  return text;
}

}  // namespace earshot::report
