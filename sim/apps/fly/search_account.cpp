#include "sim/apps/fly/search_account.hpp"

#include <array>
#include <cstdio>

#include "firmware/host/file/printable.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::fly {
namespace {

nlohmann::ordered_json or_null(const std::optional<std::uint32_t>& step) {
  return step ? nlohmann::ordered_json(*step) : nlohmann::ordered_json();
}

std::string decimals(double value, int places) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.*f", places, value);
  return text.data();
}

std::string step_in(const nlohmann::json& summary, const char* key) {
  return "step " + std::to_string(summary.at(key).get<std::uint32_t>());
}

/// What a summary says under a key; null where it has none.
nlohmann::json value_in(const nlohmann::json& summary, const char* key) {
  return summary.value(key, nlohmann::json());
}

/// Whether the vehicle swept because it had heard nothing for long: nothing had surprised it by then.
bool swept_in_silence(const nlohmann::json& summary) {
  const nlohmann::json swept = value_in(summary, "swept_from_step");
  const nlohmann::json surprised = value_in(summary, "surprised_from_step");
  return !swept.is_null() && (surprised.is_null() || surprised.get<std::uint32_t>() > swept.get<std::uint32_t>());
}

}  // namespace

void SearchAccount::note(const link::Answer& answer, Meters range) {
  believes_ = believes_ || answer.believed_source.has_value();
  surprise_bits_ = answer.surprise_bits;
  if (answer.surprise_bits >= messages::kSurprising_bits && !surprised_step_) surprised_step_ = answer.steps_taken;
  if (answer.is_sweeping && !sweep_step_) sweep_step_ = answer.steps_taken;
  if (answer.is_found && !declaration_) declaration_ = {.step = answer.steps_taken, .range = range};
}

nlohmann::ordered_json SearchAccount::to_json() const {
  nlohmann::ordered_json json{{"surprise_bits", nullptr},
                              {"surprised_from_step", or_null(surprised_step_)},
                              {"swept_from_step", or_null(sweep_step_)},
                              {"declared_found", nullptr}};
  if (believes_) json["surprise_bits"] = surprise_bits_;
  if (declaration_) json["declared_found"] = {{"step", declaration_->step}, {"range_m", declaration_->range.value}};
  return json;
}

std::string outcome(const nlohmann::json& s) {
  if (s.at("found").get<bool>()) return "source found";
  const std::string reason = s.at("end_reason");
  if (reason == "earshotd_lost") return "the flight was lost: earshotd ended or did not answer";
  if (reason == "bus_lost") return "the flight was lost: a set-point did not arrive over the bus";
  if (reason == "nothing_heard") return "the flight was lost: the vehicle's detector gave no SNR";
  if (reason == "simulator_failed") return "the flight was lost: the simulator failed";
  if (reason == "steps_used_up") return "source not found: all " + std::to_string(s.at("steps").get<int>()) + " steps taken";
  if (const nlohmann::json declared = value_in(s, "declared_found"); reason == "declared_found" && !declared.is_null())
    return "declared found, wrongly: " + decimals(declared.at("range_m"), 0) + " m from the source";
  return "source not found: " + host::spelled_apart(reason);
}

std::string account_lines(const nlohmann::json& s) {
  std::string text;
  if (!value_in(s, "surprise_bits").is_null()) {
    // A number of bits says nothing without the one from which it is a surprise.
    const std::string end = decimals(s.at("surprise_bits"), 1) + " bits at the end, a surprise from " +
                            decimals(static_cast<double>(messages::kSurprising_bits), 2) + " on";
    text += "  surprise    ";
    text += value_in(s, "surprised_from_step").is_null()
                ? (swept_in_silence(s) ? "none by what it heard, but it heard less than its tables say"
                                       : "none: the oceans of its tables explain what it heard")
                : "from " + step_in(s, "surprised_from_step") + " on what it heard was unlikely in every ocean of its tables";
    text += " (" + end + ")\n";
  }
  if (!value_in(s, "swept_from_step").is_null())
    text += "  swept       from " + step_in(s, "swept_from_step") + " of " + std::to_string(s.at("max_steps").get<int>()) +
            (swept_in_silence(s) ? " on: it had heard nothing for long, where its tables say that it should\n"
                                 : " on: what it heard fitted no ocean of its tables\n");
  if (const nlohmann::json declared = value_in(s, "declared_found"); !declared.is_null()) {
    const double range_m = declared.at("range_m");
    const bool is_wrong = range_m > s.at("step_length_m").get<double>();
    text += "  declared    found at " + step_in(declared, "step") + (is_wrong ? ", wrongly: " : ": ") + decimals(range_m, 0) +
            " m from the source\n";
  } else if (s.at("found").get<bool>() && !value_in(s, "surprise_bits").is_null()) {
    text += "  declared    not by the vehicle: the simulator ended the search within a step length of the source; at sea it would go on\n";
  }
  return text;
}

}  // namespace earshot::fly
