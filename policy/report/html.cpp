#include "policy/report/html.hpp"

#include <cmath>

#include "policy/explain/wording.hpp"

namespace earshot::report {
namespace {

/// Three readers: a screen of any width, light or dark, and paper. Below 40rem a table of decisions becomes a list whose cells name
/// themselves; nothing stands beyond the edge of the page but a table that is scrolled by itself.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ink: #1d2733; --soft: #5c6b7a; --line: #d9e0e7; --paper: #ffffff; --card: #f4f7fa; --bar: #3f8fc5; --good: #1a7a54; --bad: #b5371c; }
@media screen and (prefers-color-scheme: dark) { :root { --ink: #e4eaf0; --soft: #9aa8b5; --line: #2d3843; --paper: #12181f; --card: #1a222b; --bar: #5aa9dc; --good: #46c493; --bad: #e8734f; } }
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.25rem 4rem; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .25rem; text-wrap: balance; } h2 { font-size: 1.15rem; margin: 2.25rem 0 .75rem; } p { color: var(--soft); margin: .25rem 0; }
.found { color: var(--good); } .missed { color: var(--bad); }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: .75rem; margin: 1.25rem 0 0; }
dl div { background: var(--card); border-radius: .5rem; padding: .6rem .8rem; } dt { color: var(--soft); font-size: .82rem; } dd { margin: 0; font-size: 1.2rem; font-variant-numeric: tabular-nums; } dd.meaning { color: var(--soft); font-size: .82rem; line-height: 1.35; }
.note { color: var(--ink); border-left: .25rem solid var(--bar); padding: .1rem 0 .1rem .8rem; margin: .6rem 0; }
.chart { max-width: 38rem; margin: 0 auto; } .chart svg { display: block; width: 100%; height: auto; } .cells image { image-rendering: pixelated; }
.table { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .85rem; font-variant-numeric: tabular-nums; } th { color: var(--soft); font-weight: 600; vertical-align: bottom; }
th, td { padding: .2rem .5rem; border-bottom: 1px solid var(--line); text-align: right; overflow-wrap: normal; } td { white-space: nowrap; } .heard { color: var(--good); }
td.p { position: relative; min-width: 1.8rem; } td.p i { position: absolute; left: .2rem; top: .2rem; bottom: .2rem; width: calc(var(--share) * (100% - .4rem)); background: var(--bar); opacity: .35; border-radius: 2px; } td.p.taken { font-weight: 700; }
td.part { min-width: 6rem; padding: .2rem 0; } td.part b { display: block; position: relative; height: 1em; background: linear-gradient(var(--soft), var(--soft)) 50% / 1px 100% no-repeat; } td.part i { position: absolute; top: 0; bottom: 0; width: calc(var(--share) * 50%); opacity: .55; } td.part .for { left: 50%; background: var(--good); } td.part .against { right: 50%; background: var(--bad); }
.actions td.p { min-width: 5rem; } .columns { color: var(--soft); font-size: .82rem; line-height: 1.4; padding-left: 1.2rem; margin: .5rem 0; }
th.left, td.left { text-align: left; white-space: normal; } .words { color: var(--ink); padding-left: 1.2rem; } .words li { margin: .2rem 0; }
summary { cursor: pointer; color: var(--soft); } tr.why > td { text-align: left; white-space: normal; overflow-wrap: anywhere; padding-bottom: .6rem; } tr.step > td { border-bottom: 0; }
@media screen and (max-width: 40rem) {
  body { padding: 1.25rem .9rem 3rem; } dl { grid-template-columns: repeat(auto-fit, minmax(8rem, 1fr)); gap: .5rem; }
  .decisions { display: block; } .decisions > tbody { display: block; } .decisions > thead { display: none; }
  tr.step { display: grid; grid-template-columns: repeat(40, minmax(0, 1fr)); padding-top: .5rem; } tr.step > td { grid-column: span 8; text-align: left; padding: .1rem .2rem; } tr.step > td.p { grid-column: span 5; min-width: 0; } tr.step > td:last-child { grid-column: span 40; } tr.step > td:empty { display: none; }
  tr.step > td[data-name]::before { content: attr(data-name); display: block; color: var(--soft); font-size: .72rem; font-weight: 400; }
  tr.why, tr.why > td { display: block; padding-left: 0; padding-right: 0; }
  .actions, .actions > tbody { display: block; } .actions > thead { display: none; }
  .actions > tbody > tr { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); padding: .5rem 0; border-bottom: 1px solid var(--line); } .actions > tbody > tr > td { text-align: left; white-space: normal; border-bottom: 0; padding: .1rem .2rem; min-width: 0; } .actions > tbody > tr > td > i { display: none; } .actions > tbody > tr > td.left { grid-column: span 3; font-size: .85rem; }
  .actions > tbody > tr > td[data-name]::before { content: attr(data-name); display: block; color: var(--soft); font-size: .72rem; font-weight: 400; }
  th, td { padding: .2rem .12rem; font-size: .72rem; } th { font-size: .64rem; } td.part { min-width: 2.4rem; }
}
@media print {
  @page { margin: 14mm; } :root { font-size: 11px; } body { max-width: none; padding: 0; font-size: 11px; } * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .table { overflow: visible; } th, td { padding: .15rem .3rem; } .actions td.p, td.part { min-width: 4rem; } .chart { max-width: 30rem; }
  thead { display: table-header-group; } tr.step, .decisions .table, .chart, dl div { break-inside: avoid; } tr.step, h2, summary { break-after: avoid; }
}
)";

}  // namespace

std::string html_head(const std::string& title) {
  return R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>)" +
         escaped(title) + "</title><style>" + std::string(kStyle) + "</style></head>" +
         // What is folded on a screen must stand on paper.
         "<body onbeforeprint=\"for (const part of document.querySelectorAll('details')) part.open = true\">\n";
}

std::string fact(std::string_view name, const std::string& value, const std::string& meaning) {
  return "<div><dt>" + std::string(name) + "</dt><dd>" + value + "</dd>" +
         (meaning.empty() ? "" : "<dd class=\"meaning\">" + meaning + "</dd>") + "</div>\n";
}

std::string percent_cell(std::string_view name, double share, bool is_taken) {
  const std::string percent = explain::fixed(100.0 * share, 0);
  const std::string bar = percent == "0" ? "" : "<i style=\"--share:" + explain::fixed(share, 3) + "\"></i>";
  return "<td data-name=\"" + std::string(name) + "\" class=\"p" + (is_taken ? " taken" : "") + "\">" + bar + percent + "</td>";
}

std::string signed_bar_cell(double share) {
  return std::string("<td class=\"part\"><b><i class=\"") + (share >= 0.0 ? "for" : "against") +
         "\" style=\"--share:" + explain::fixed(std::abs(share), 3) + "\"></i></b></td>";
}

}  // namespace earshot::report
