#pragma once

#include "firmware/messages/challenge.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/message.hpp"

namespace earshot::messages {

// Orders, and what they are answered and marked with.

/// What a port found an order's mark to be: 1 that of who knows the vehicle's key, 2 likewise, but made for no start of its program.
struct MarkWorth : Line {
  using Reaches = Types<At<&OperatorCommand::is_verified>, At<&OperatorCommand::has_old_mark>>;
  static constexpr std::int8_t kVerified = 1;
  static constexpr std::int8_t kOldMark = 2;

  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kBoolean, .name = name}}}; }

  static constexpr void write(const OperatorCommand& command, auto& out) {
    out.number(command.is_verified ? kVerified : command.has_old_mark ? kOldMark : std::int8_t{0});
  }
  static constexpr void hear(auto& in, OperatorCommand& command) {
    const auto worth = in.template number<std::int8_t>();
    command.is_verified = worth == kVerified;
    command.has_old_mark = worth == kOldMark;
  }
  static constexpr bool in_files(const OperatorCommand& command) { return command.is_verified; }
};

template <>
struct Described<OperatorCommand> {
  static constexpr std::string_view kType = "operator_command_t";
  static constexpr std::string_view kChannel = "EARSHOT_OPERATOR_COMMAND";
  static constexpr std::string_view kMeaning =
      "Order of a person (or of the simulator in a person's place).\n"
      "It is acknowledged on EARSHOT_COMMAND_ACKNOWLEDGEMENT; send the same numbers again until it is.";
  static constexpr LineList kFields{
      field<&OperatorCommand::time>("utime", {.meaning = "when it was given; refused when more than 30 s from its arrival (but for ABORT)",
                                              .key = "given_time_s",
                                              .bus = on_bus::instant("Time", 96)}),
      field<&OperatorCommand::expiry>("expiry_utime",
                                      {.meaning = "not to be obeyed after (but for ABORT); a START that waits for navigation and SNR ends "
                                                  "with it, too",
                                       .key = "expiry_time_s",
                                       .bus = on_bus::instant("Expiry", 160)}),
      field<&OperatorCommand::issuer>("issuer", {.meaning = "a number of the sender's own, best drawn anew whenever it starts",
                                                 .bus = on_bus::any_number("Issuer", 32)}),
      field<&OperatorCommand::number>("number",
                                      {.meaning = "rises with every new command of this issuer", .bus = on_bus::any_number("Number", 64)}),
      field<&OperatorCommand::order>("command",
                                     {.key = "order", .values = FieldFormat::Values::kPlain, .bus = on_bus::number("Order", 24, 8)}),
      optional_field<&OperatorCommand::limits, &OperatorLimits::max_depth>(
          "max_depth_m",
          {.meaning = "of a TIGHTEN; NaN: stays as it is",
           .bus = on_bus::within(0, 12'000, on_bus::number("MaxDepth", 224, 24, on_bus::kUnsigned, on_bus::kHundredth, "m"))}),
      optional_field<&OperatorCommand::limits, &OperatorLimits::max_speed>(
          "max_speed_mps",
          {.meaning = "likewise", .bus = on_bus::number("MaxSpeed", 248, 16, on_bus::kUnsigned, on_bus::kHundredth, "m/s")}),
      optional_field<&OperatorCommand::limits, &OperatorLimits::max_time_s>(
          "max_time_s", {.meaning = "likewise", .bus = on_bus::number("MaxTime", 264, 32, on_bus::kUnsigned, on_bus::kOne, "s")}),
      bytes<&OperatorCommand::mark>("mark", {.meaning = "where the mission names a key (firmware/authority/README.md); else zeros: in "
                                                        "Python mark = bytes(16), always set",
                                             .is_in_files = false,
                                             .bus_words = bus_words(296, "Mark0", "Mark1", "Mark2", "Mark3")}),
      MarkWorth{{"verified",
                 {.meaning = "of the journal: what Earshot found (2: not verified, its mark lacks the challenge; "
                             "lcm-gen's Python reads that as True); a sender's is not looked at"}}},
  };
};

template <>
struct Described<CommandAcknowledgement> {
  static constexpr std::string_view kType = "command_acknowledgement_t";
  static constexpr std::string_view kChannel = "EARSHOT_COMMAND_ACKNOWLEDGEMENT";
  static constexpr std::string_view kMeaning =
      "What became of an operator command; the same again, sent because this was lost, is answered with the same outcome. It leaves by the "
      "port that the\n"
      "command came by.";
  static constexpr LineList kFields{
      field<&CommandAcknowledgement::time>("utime", {.is_in_files = false, .bus = on_bus::instant("Time", 104)}),
      field<&CommandAcknowledgement::issuer>("issuer", {.bus = on_bus::any_number("Issuer", 32)}),
      field<&CommandAcknowledgement::number>("number", {.bus = on_bus::any_number("Number", 64)}),
      field<&CommandAcknowledgement::order>("command", {.key = "order", .bus = on_bus::number("Order", 24, 8)}),
      field<&CommandAcknowledgement::outcome>("outcome", {.values = FieldFormat::Values::kPlain, .bus = on_bus::number("Outcome", 96, 8)}),
      unpublished<At<&CommandAcknowledgement::port>>(),
  };
};

template <>
struct Described<PublishedChallenge> {
  static constexpr std::string_view kType = "challenge_t";
  static constexpr std::string_view kChannel = "EARSHOT_CHALLENGE";
  static constexpr std::string_view kMeaning =
      "What the marks of orders are made for besides the order (firmware/authority/README.md): this vehicle, this start of its program, "
      "this mission.\n"
      "Every turn, of a vehicle whose mission names a key.";
  static constexpr LineList kFields{
      field<&PublishedChallenge::time>("utime", {.bus = on_bus::instant("Time", 16)}),
      bytes<&PublishedChallenge::challenge, &Challenge::nonce>(
          "nonce", {.meaning = "drawn anew at every start", .bus_words = bus_words(80, "Nonce0", "Nonce1", "Nonce2", "Nonce3")}),
      bytes<&PublishedChallenge::challenge, &Challenge::vehicle>(
          "vehicle",
          {.meaning = "its name in ASCII, zeros behind; nothing but zeros: it has none",
           .bus_words = bus_words(208, "Vehicle0", "Vehicle1", "Vehicle2", "Vehicle3", "Vehicle4", "Vehicle5", "Vehicle6", "Vehicle7")}),
      bytes<&PublishedChallenge::challenge, &Challenge::mission>(
          "mission",
          {.meaning = "SHA-256 of the mission's file",
           .bus_words = bus_words(464, "Mission0", "Mission1", "Mission2", "Mission3", "Mission4", "Mission5", "Mission6", "Mission7")}),
      bytes<&PublishedChallenge::mark>(
          "mark", {.meaning = "of who knows the key, so that nobody else can have orders marked for another vehicle",
                   .bus_words = bus_words(720, "ChallengeMark0", "ChallengeMark1", "ChallengeMark2", "ChallengeMark3")}),
  };
};

}  // namespace earshot::messages
