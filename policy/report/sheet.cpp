#include "policy/report/sheet.hpp"

#include "policy/report/belief_pictures.hpp"
#include "policy/report/explanation.hpp"
#include "policy/report/html.hpp"

namespace earshot::report {
namespace {

using explain::fixed;

constexpr std::size_t kRows = 8;  ///< of the observation, shown on a sheet

std::string subtitle(const Sheet& sheet) {
  const explain::RecordedDecision& d = sheet.account.decision;
  return duration(d.time_s - sheet.looks().front().time_s) + " after the first decision, " + fixed(d.position.north.value / 1e3, 2) +
         " km north, " + fixed(d.position.east.value / 1e3, 2) + " km east. Journal " + sheet.flight.journal_path.string() + ", policy " +
         sheet.flight.policy_path.string() + ": replayed, and every decision up to the last comes out bit for bit.";
}

std::string notes(const Sheet& sheet) {
  return lack_of(sheet.flight.journal);
}

}  // namespace

Sheet make_sheet(const RecordedFlight& flight, std::size_t index, explain::Baseline baseline) {
  const auto decisions = std::span(flight.journal.decisions).first(index + 1);
  return {.flight = flight, .index = index, .account = explain::account_of(flight.circumstances(baseline), decisions)};
}

std::string title_of(const Sheet& sheet) {
  const explain::DecisionAccount& a = sheet.account;
  return "Step " + std::to_string(a.decision.step) + ": why it went " + a.actions[a.decision.action].name;
}

std::string as_html(const Sheet& sheet) {
  const explain::DecisionAccount& a = sheet.account;
  std::string text =
      html_head("Earshot: " + title_of(sheet)) + "<h1>" + title_of(sheet) + "</h1>\n<p>" + escaped(subtitle(sheet)) + "</p>\n";
  if (!notes(sheet).empty()) text += "<p class=\"missed\">" + notes(sheet) + "</p>\n";
  text += "<ul class=\"words\">\n";
  for (const std::string& sentence : sentences(a)) text += "<li>" + escaped(sentence) + "</li>\n";
  text += "</ul>\n<h2>Where the source is believed to be</h2>\n<div class=\"chart cells\">" +
          belief_svgs({{.account = a, .looks = sheet.looks(), .source = sheet.flight.source}}).front() + "</div>\n";
  text += "<h2>What it could do</h2>\n" + actions_table(a);
  text +=
      "<h2>What moved the choice</h2>\n<p>Integrated gradients of the log-probability of what was taken: a part of 0.69 nats doubles its "
      "chance.</p>\n" +
      attribution_tables(a, kRows);
  text += "<h2>What was heard</h2>\n" + looks_table(sheet.looks());
  text += "<h2>Everything it saw</h2>\n<details><summary>" + std::to_string(a.observed.size()) + " numbers</summary>\n" +
          observation_table(a) + "</details>\n";
  return text + std::string(kHtmlEnd);
}

std::string as_markdown(const Sheet& sheet) {
  const explain::DecisionAccount& a = sheet.account;
  std::string text = "# " + title_of(sheet) + "\n" + subtitle(sheet) + "\n\n";
  if (!notes(sheet).empty()) text += notes(sheet) + "\n\n";
  for (const std::string& sentence : sentences(a)) text += "- " + sentence + "\n";
  text += "\n| direction | chosen with (%) | would hear (dB) | detects (%) | finds (%) | nearer by (km) |\n|---|---|---|---|---|---|\n";
  for (const explain::ActionAccount& action : a.actions) {
    text += "| " + action.name + " | " + fixed(100.0 * action.probability, 0) + " | " + fixed(action.hear.snr.value, 1) + " \u00B1 " +
            fixed(action.hear.spread.value, 1) + " | " + fixed(100.0 * action.detected, 0) + " | " + fixed(100.0 * action.found, 1) +
            " | " + fixed(action.approach.value / 1e3, 2) + " |\n";
  }
  text += "\n| observation | seen | baseline | nats | chance |\n|---|---|---|---|---|\n";
  for (const explain::ObservedAccount& o : explain::weightiest(a, kRows))
    text += "| " + o.name + " | " + o.value + " | " + o.baseline + " | " + fixed(o.part, 3) + " | " + factor_in_words(o.part) + " |\n";
  text += "\nCompared with " + baseline_in_words(a.baseline) + ": " + completeness_in_words(a.attribution) + ".\n";
  text += "\n| step | north (km) | east (km) | heard |\n|---|---|---|---|\n";
  for (const explain::RecordedDecision& look : sheet.looks())
    text += "| " + std::to_string(look.step) + " | " + fixed(look.position.north.value / 1e3, 2) + " | " +
            fixed(look.position.east.value / 1e3, 2) + " | " + heard_in_words(look.heard) + (look.detected ? ", a detection" : "") + " |\n";
  return text;
}

}  // namespace earshot::report
