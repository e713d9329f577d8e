#include "hil/bus/decode/desk_messages.hpp"

#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {

namespace {

using namespace n2k::table;
using n2k::Choice;
using n2k::Message;
using n2k::Signal;

constexpr Choice kTimeSource[]{
    {0, "GPS"}, {1, "GLONASS"}, {2, "Radio Station"}, {3, "Local Cesium clock"}, {4, "Local Rubidium clock"}, {5, "Local Crystal clock"}};
constexpr Choice kGnssMode[]{{0, "1D"}, {1, "2D"}, {2, "3D"}, {3, "Auto"}};
constexpr Choice kHumiditySource[]{{0, "Inside"}, {1, "Outside"}};

constexpr Signal kSystemTimeSignals[]{
    sequence_identifier(0),
    choice("Source", 8, 4, kTimeSource),
    date("Date", 16),
    time_of_day("Time", 32),
};

constexpr Signal kHeaveSignals[]{
    sequence_identifier(0),
    number("Heave", 8, 16, kSigned, kHundredth, "m"),
};

constexpr Signal kGnssDopsSignals[]{
    sequence_identifier(0),
    choice("DesiredMode", 8, 3, kGnssMode),
    choice("ActualMode", 11, 3, kGnssMode),
    number("HDOP", 16, 16, kSigned, kHundredth),
    number("VDOP", 32, 16, kSigned, kHundredth),
    number("TDOP", 48, 16, kSigned, kHundredth),
};

constexpr Signal kEnvironmentSignals[]{
    sequence_identifier(0),
    choice("TemperatureSource", 8, 6, kTemperatureSource),
    choice("HumiditySource", 14, 2, kHumiditySource),
    number("Temperature", 16, 16, kUnsigned, kHundredth, "K"),
    number("Humidity", 32, 16, kSigned, {4, 1000}, "%"),
    number("AtmosphericPressure", 48, 16, kUnsigned, {100, 1}, "Pa"),
};

constexpr Message kDeskMessages[]{
    single("SystemTime", 126992, 3, kToRuntime, kOnOccasion, kSystemTimeSignals),
    single("Heave", 127252, 3, kToRuntime, kOnOccasion, kHeaveSignals),
    single("GNSSDOPs", 129539, 6, kToRuntime, kOnOccasion, kGnssDopsSignals),
    single("EnvironmentalParameters", 130311, 5, kToRuntime, kOnOccasion, kEnvironmentSignals),
};

}  // namespace

std::span<const Message> desk_messages() {
  return kDeskMessages;
}

}  // namespace earshot::hil
