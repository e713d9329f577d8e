#include "firmware/wire/n2k/node/identity.hpp"

#include "firmware/wire/n2k/codec.hpp"

namespace earshot::n2k {

Result<Name> name_of(const NameParts& parts) {
  MessageWriter claim(table::kAddressClaim);
  claim.set_raw("UniqueNumber", parts.unique_number)
      .set_raw("ManufacturerCode", parts.manufacturer)
      .set_raw("DeviceInstanceLower", parts.device_instance & 7U)
      .set_raw("DeviceInstanceUpper", parts.device_instance >> 3U)
      .set_raw("DeviceFunction", parts.device_function)
      .set_raw("DeviceClass", parts.device_class)
      .set_raw("SystemInstance", parts.system_instance)
      .set_raw("IndustryGroup", table::kMarineIndustry)
      .set_raw("ArbitraryAddressCapable", 1);
  Frame frame;
  const Status status = claim.frame(kNullAddress, frame);
  if (status != Status::kOk) return status;
  frame.data[6] &= 0xFEU;  // a spare bit, which is zero
  return *name_in(frame);
}

}  // namespace earshot::n2k
