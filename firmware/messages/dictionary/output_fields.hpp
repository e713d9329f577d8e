#pragma once

#include "firmware/messages/decision.hpp"
#include "firmware/messages/dictionary/input_fields.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::messages {

// What the vehicle is ordered to do, and what it reports of itself.

template <>
struct Described<Setpoint> {
  static constexpr std::string_view kType = "setpoint_t";
  static constexpr std::string_view kChannel = "EARSHOT_SETPOINT";
  static constexpr std::string_view kMeaning = "What the autopilot is to do.";
  static constexpr LineList kFields{
      sent_time("utime"),
      field<&Setpoint::heading>("heading_rad", {.meaning = "clockwise from north"}),
      field<&Setpoint::speed>("speed_mps", {.bus = on_bus::number("CommandedSpeed", 16, 16, on_bus::kUnsigned, on_bus::kHundredth, "m/s")}),
      field<&Setpoint::depth>(
          "depth_m",
          {.meaning = "positive down",
           .bus = on_bus::within(0, 12'000, on_bus::number("CommandedDepth", 32, 24, on_bus::kUnsigned, on_bus::kHundredth, "m"))}),
      field<&Setpoint::waypoint, &NorthEast::north>("waypoint_north_m"),
      field<&Setpoint::waypoint, &NorthEast::east>("waypoint_east_m"),
      field<&Setpoint::release_weight>("release_weight",
                                       {.meaning = "the mission was aborted by a rule that asks for the drop weight to be released",
                                        .bus = on_bus::number("ReleaseWeight", 60, 4)}),
  };
};

template <>
struct Described<Decision> {
  static constexpr std::string_view kType = "decision_t";
  static constexpr std::string_view kChannel = "EARSHOT_DECISION";
  static constexpr std::string_view kMeaning = "Why the vehicle goes where it goes: one record per action.";
  static constexpr std::size_t kPublishedObservation = 64;
  static constexpr std::size_t kPublishedLogits = 32;
  static_assert(config::kMaxObservation <= kPublishedObservation && config::kMaxActions <= kPublishedLogits);
  static constexpr LineList kFields{
      field<&Decision::time>("utime", {.is_in_files = false, .bus = on_bus::instant("Time", 16)}),
      field<&Decision::step>("step", {.meaning = "0 for the first action", .bus = on_bus::any_number("Step", 80)}),
      field<&Decision::position, &NorthEast::north>("north_m", {.bus = on_bus::metres("North", 112)}),
      field<&Decision::position, &NorthEast::east>("east_m", {.bus = on_bus::metres("East", 144)}),
      field<&Decision::snr>("snr_db",
                            {.bus = on_bus::within(-600, 600, on_bus::number("SNR", 176, 18, on_bus::kSigned, on_bus::kHundredth, "dB"))}),
      field<&Decision::too_faint>(
          "too_faint", {.meaning = "not measured: the signal lies somewhere below snr_db", .bus = on_bus::number("TooFaint", 194, 2)}),
      field<&Decision::detected>("detected", {.bus = on_bus::number("Detected", 196, 2)}),
      whether_there<&Decision::bearing>("has_bearing",
                                        {.meaning = "heard with the SNR; false: none was, and its numbers are zero", .is_in_files = false}),
      field<&Decision::bearing, &Bearing::direction>("bearing_rad", {.meaning = "as in bearing_t"}),
      field<&Decision::bearing, &Bearing::deviation>("bearing_deviation_rad"),
      whether_there<&Decision::bearing, &Bearing::mirror_axis>("bearing_ambiguous"),
      field<&Decision::bearing, &Bearing::mirror_axis>("bearing_axis_rad"),
      field<&Decision::action>("action", {.bus = on_bus::number("Action", 200, 8)}),
      field<&Decision::sweeping>("sweeping",
                                 {.meaning = "what was heard fits nothing that is believed possible: the action is the sweep's, "
                                             "not the policy's"}),
      field<&Decision::overridden>("overridden",
                                   {.meaning = "the safety layer changed the way-point", .bus = on_bus::number("Overridden", 198, 2)}),
      field<&Decision::waypoint, &NorthEast::north>("waypoint_north_m", {.bus = on_bus::metres("WaypointNorth", 208)}),
      field<&Decision::waypoint, &NorthEast::east>("waypoint_east_m", {.bus = on_bus::metres("WaypointEast", 240)}),
      field<&Decision::observation_size>("observation_size", {.is_in_files = false}),
      field<&Decision::action_count>("action_count", {.is_in_files = false}),
      floats<&Decision::observation, &Decision::observation_size, kPublishedObservation>("observation"),
      floats<&Decision::logits, &Decision::action_count, kPublishedLogits>("logits"),
      whether_there<&Decision::belief>("believes", {.meaning = "false: the policy holds no belief, and the rest is zero",
                                                    .heading = "What was believed about the source, in the mission's frame."}),
      field<&Decision::belief, &BeliefSummary::likeliest, &NorthEast::north>("likeliest_north_m",
                                                                             {.bus = on_bus::metres("LikeliestNorth", 272)}),
      field<&Decision::belief, &BeliefSummary::likeliest, &NorthEast::east>("likeliest_east_m",
                                                                            {.bus = on_bus::metres("LikeliestEast", 304)}),
      field<&Decision::belief, &BeliefSummary::mean, &NorthEast::north>("mean_north_m", {.bus = on_bus::metres("MeanNorth", 336)}),
      field<&Decision::belief, &BeliefSummary::mean, &NorthEast::east>("mean_east_m", {.bus = on_bus::metres("MeanEast", 368)}),
      field<&Decision::belief, &BeliefSummary::spread>(
          "spread_m", {.meaning = "root mean square distance from the mean",
                       .bus = on_bus::number("Spread", 400, 32, on_bus::kUnsigned, on_bus::kHundredth, "m")}),
      field<&Decision::belief, &BeliefSummary::likeliest_share>(
          "likeliest_share", {.meaning = "probability of the likeliest cell",
                              .bus = on_bus::within(0, 1, on_bus::number("LikeliestShare", 432, 16, on_bus::kUnsigned, {1, 60'000}))}),
      field<&Decision::belief, &BeliefSummary::effective_cells>(
          "effective_cells", {.meaning = "cells the belief is spread over",
                              .bus = on_bus::number("EffectiveCells", 448, 32, on_bus::kUnsigned, on_bus::kHundredth)}),
      field<&Decision::belief, &BeliefSummary::mismatch_bits>(
          "surprise_bits", {.meaning = "how unlikely what was heard is under all that is believed possible"}),
      whether_there<&Decision::found>(
          "found", {.meaning = "false: it is not declared, and the rest is zero", .heading = "That the source is found here, and why."}),
      field<&Decision::found, &FoundDeclaration::probability>("found_probability",
                                                              {.meaning = "that the source lies within a step length of the vehicle"}),
      field<&Decision::found, &FoundDeclaration::least_snr>("found_least_snr_db",
                                                            {.meaning = "that is expected within a step length of the source"}),
      field<&Decision::found, &FoundDeclaration::closest_approach>("closest_approach_m",
                                                                   {.meaning = "from the likeliest place to the vehicle"}),
      // The decision holds these itself, but for the number of near SNR measurements.
      unpublished<At<&Decision::found, &FoundDeclaration::snr>, At<&Decision::found, &FoundDeclaration::likeliest>,
                  At<&Decision::found, &FoundDeclaration::measurement>, At<&Decision::found, &FoundDeclaration::near_measurements>>(),
  };
  static constexpr void derive(Decision& decision) {
    if (!decision.found) return;
    decision.found->snr = decision.snr;
    decision.found->measurement = decision.step;
    if (decision.belief) decision.found->likeliest = decision.belief->likeliest;
  }
};

template <>
struct Described<SafetyEvent> {
  static constexpr std::string_view kType = "safety_event_t";
  static constexpr std::string_view kChannel = "EARSHOT_SAFETY_EVENT";
  static constexpr std::string_view kMeaning = "A rule of the safety supervisor begins to act, or no longer acts.";
  static constexpr LineList kFields{
      field<&SafetyEvent::time>("utime", {.is_in_files = false}),
      field<&SafetyEvent::rule>("rule",
                                {.meaning = "its place among the mission's rules, those first that no mission can switch off; counts "
                                            "from 0, where words, files and the list of earshotd --check count from 1: \"rule 12\" is 11",
                                 .counts_from_one_in_files = true}),
      field<&SafetyEvent::condition>("condition", {.meaning = "Condition of firmware/config/safety.hpp"}),
      field<&SafetyEvent::response>("response", {.meaning = "Response of the same"}),
      field<&SafetyEvent::begins>("begins", {.meaning = "false: it no longer acts"}),
      field<&SafetyEvent::measure>("measure", {.meaning = "what the rule watches, in its condition's unit"}),
      field<&SafetyEvent::limit>("limit", {.meaning = "beyond which it lies"}),
  };
};

template <>
struct Described<Health> {
  static constexpr std::string_view kType = "health_t";
  static constexpr std::string_view kChannel = "EARSHOT_HEALTH";
  static constexpr std::string_view kMeaning = "State of the runtime, and its heartbeat: the last thing that a turn does.";
  static constexpr LineList kFields{
      sent_time("utime", {.bus = on_bus::instant("Time", 16)}),
      field<&Health::turn>("turn", {.meaning = "counts the turns, from 1", .bus = on_bus::counter("Turn", 328)}),
      field<&Health::decisions>("decisions", {.meaning = "made so far in this search", .bus = on_bus::any_number("Decisions", 376)}),
      field<&Health::authority>("authority", {.meaning = "between Earshot and the autopilot",
                                              .values = FieldFormat::Values::kPrefixedIfTaken,
                                              .bus = on_bus::number("Authority", 408, 4)}),
      field<&Health::is_paused>("paused", {.meaning = "by an operator", .bus = on_bus::number("Paused", 412, 2)}),
      field<&Health::state>("state", {.values = FieldFormat::Values::kPlain, .bus = on_bus::number("State", 80, 8)}),
      field<&Health::end_reason>(
          "end_reason",
          {.meaning = "why the mission ended", .values = FieldFormat::Values::kPrefixed, .bus = on_bus::number("EndReason", 88, 8)}),
      field<&Health::steps_taken>("steps_taken", {.bus = on_bus::any_number("StepsTaken", 96)}),
      field<&Health::mismatch_bits>(
          "surprise_bits", {.meaning = "how unlikely what was heard is under all that is believed possible; below 0 where it is likely, on "
                                       "CAN 0 then; 0 without a belief",
                            .bus = on_bus::number("ModelMismatch", 472, 16, on_bus::kUnsigned, on_bus::kHundredth, "bit"),
                            .is_later_on_bus = true,
                            .saturates_on_bus = true}),
      field<&Health::is_sweeping>(
          "sweeping", {.meaning = "for that it sweeps the area", .bus = on_bus::number("Sweeping", 414, 2), .is_later_on_bus = true}),
      field<&Health::is_found>("found", {.meaning = "with its last SNR measurement the vehicle declared the source found",
                                         .bus = on_bus::number("Found", 464, 2),
                                         .is_later_on_bus = true}),
      field<&Health::counters, &Counters::navigation_refused>("navigation_refused", {.bus = on_bus::counter("NavigationRefused", 128)}),
      field<&Health::counters, &Counters::snr_refused>("snr_refused", {.bus = on_bus::counter("SNRRefused", 176)}),
      field<&Health::counters, &Counters::commands_refused>("commands_refused", {.bus = on_bus::counter("CommandsRefused", 224)}),
      field<&Health::counters, &Counters::setpoints_limited>("setpoints_limited", {.bus = on_bus::counter("SetpointsLimited", 272)}),
      field<&Health::counters, &Counters::status_refused>("status_refused", {.bus = on_bus::counter("StatusRefused", 416)}),
      field<&Health::counters, &Counters::bearings_refused>("bearings_refused"),
      field<&Health::counters, &Counters::bearings_of_others>("bearings_of_others",
                                                              {.meaning = "by a second sender, while another is listened to"}),
      field<&Health::response>("response", {.meaning = "the strongest that acts; warn: none, or warnings",
                                            .values = FieldFormat::Values::kPrefixed,
                                            .bus = on_bus::number("Response", 466, 6),
                                            .is_later_on_bus = true}),
      count_of<&Health::ports>("port_count",
                               {.meaning = "how many of `ports` are in use", .is_in_files = false, .bus = on_bus::number("Ports", 320, 8)}),
      nested<&Health::ports>("ports"),
  };
};

template <>
struct Described<SoundDetection> {
  static constexpr std::string_view kType = "detection_t";
  static constexpr std::string_view kChannel = "EARSHOT_DETECTION";
  static constexpr std::string_view kMeaning =
      "A sound that the vehicle's detector heard from its beginning to its end. It steers nothing.";
  static constexpr LineList kFields{
      field<&SoundDetection::begin>("utime", {.meaning = "when it began, microseconds, UTC by the wall clock", .key = "begin_time_s"}),
      field<&SoundDetection::duration>("duration_us", {.key = "duration_s"}),
      field<&SoundDetection::level>("level_db_re_1upa",
                                    {.meaning = "of its loudest integration time: signal and noise in the detector's band"}),
      field<&SoundDetection::snr>("snr_db", {.meaning = "of the same"}),
      field<&SoundDetection::is_clipped>("clipped", {.meaning = "samples of it were at full scale: it was louder than given here"}),
  };
};

}  // namespace earshot::messages
