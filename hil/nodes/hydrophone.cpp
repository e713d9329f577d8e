#include "hil/nodes/hydrophone.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {

std::unique_ptr<Sensor> make_hydrophone(const vehicle::State& vehicle, SoundSource source, const HydrophoneFault& fault,
                                        std::uint32_t unique_number) {
  const auto compose = [&vehicle, &fault, source = std::move(source)](const Occasion& o, Frames& frames) {
    const Decibels snr = source.snr(range_between(vehicle.position, source.position)) + fault.gain_error;
    n2k::Frame frame;
    const Status status = fault.is_deaf ? n2k::compose_deaf(true, o.source, frame)
                                        : n2k::compose_snr({.snr = snr, .too_faint = false, .band_level = {}}, o.source, frame);
    if (status == Status::kOk) frames.push_back(frame);
    return status;
  };
  const Nameplate plate{.model = "hydrophone",
                        .device_class = 85,  // external environment
                        .device_function = 160,
                        .preferred_address = 0x28,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(
      plate, std::vector<Broadcast>{{.message = n2k::table::kSnr, .period = Duration::seconds(1), .compose = compose}});
}

}  // namespace earshot::hil
