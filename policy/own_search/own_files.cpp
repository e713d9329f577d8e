#include "policy/own_search/own_files.hpp"

#include <cmath>
#include <string_view>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "policy/own_search/own_policy.hpp"
#include "policy/own_search/template_text.hpp"

namespace earshot::own_search {
namespace {

namespace fs = std::filesystem;

// Of every mission that ships.
constexpr double kStepLength_m = 1000.0;
constexpr double kMaxSteps = 100.0;

const char* const kOverLcm = " over LCM, which a computer without a CAN bus has, too (without `--bus lcm`: over the mission's)";

const fs::path kMissions = "firmware/boards/linux/missions";

TemplateText shipped_text(const fs::path& relative) {
  const fs::path file = host::shipped(relative);
  return {host::read_text(file, host::kTomlFile), file};
}

const char* mission_of(const std::string& bus) {
  if (bus == "can") return "search_over_can_alone.toml";
  return bus == "mixed" ? "search_over_can.toml" : "search.toml";
}

/// As a shell takes it for one word that is nothing but itself.
std::string shell_word(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,@%";
  if (text.find_first_not_of(kPlain) == std::string_view::npos) return std::string(text);
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

/// How a person at this computer calls a program of ours: an installed one by its name alone.
std::string command(const char* program) {
  const fs::path folder = host::own_folder();
  return folder == "/usr/bin" || folder == "/usr/local/bin" ? program : shell_word((folder / program).string());
}

void set_policy(TemplateText& mission, FliesBy by) {
  const bool ships = by == FliesBy::kWhatShips;
  const fs::path own_public_key = fs::path(kKeyFile).replace_extension(".pub");
  mission.set("policy", "file", toml_text(ships ? host::shipped("policy/frozen/shipped.policy").string() : kPolicyFile));
  mission.set("policy", "public_key_file", toml_text((ships ? host::shipped("policy/frozen/earshot.pub") : own_public_key).string()));
}

/// Shallower water has no sound channel with its axis at 1300 m.
constexpr double kLeastForSoundChannel_m = 2000.0;

/// The line that begins so, whole.
void replace_line(std::string& text, const std::string& begin, const std::string& line) {
  const std::size_t at = text.find("\n" + begin) + 1;
  text.replace(at, text.find('\n', at) - at, line);
}

std::string noise_remark(const OwnSearch& search) {
  const std::string frequency = toml_number(search.frequency_hz) + " Hz";
  if (search.noise_db) return "  # in the detector's band, from --noise-db";
  return "  # in the detector's band: Wenz curves at " + frequency + ", about, for ships and wind of 5 m/s (90 dB at 20 Hz)";
}

/// Well mixed water, in which sound is faster the deeper it is: by 0.017 m/s every metre of pressure alone.
void replace_water(std::string& text, double sea_floor_m) {
  constexpr double kSurface_mps = 1490.0;
  constexpr double kPerMetre = 0.017;
  const std::size_t begin = text.find("[water]\n");
  text.replace(
      begin, text.find("[seabed]\n") - begin,
      "[water]\nprofile = \"table\"                  # linear between its depths, from the surface to the sea floor: well mixed water\n"
      "depth_m         = [   0.0, " +
          toml_number(sea_floor_m) + "]\nsound_speed_mps = [1490.0, " + toml_number(kSurface_mps + kPerMetre * sea_floor_m) + "]\n\n");
}

/// Sand on a shelf, silt on a slope, mud in the deep sea. Source: Jensen et al. (2011), Computational Ocean Acoustics, table 1.3.
void replace_seabed(std::string& text, double sea_floor_m) {
  constexpr double kShelf_m = 200.0;
  constexpr double kDeepSea_m = 1000.0;
  if (sea_floor_m >= kDeepSea_m) return;
  const bool is_shelf = sea_floor_m <= kShelf_m;
  replace_line(text, "sound_speed_mps = 1505.0",
               is_shelf ? "sound_speed_mps = 1650.0           # sand" : "sound_speed_mps = 1575.0           # silt");
  replace_line(text, "density_g_per_cm3", is_shelf ? "density_g_per_cm3 = 1.9" : "density_g_per_cm3 = 1.7");
  replace_line(text, "attenuation_db_per_wavelength",
               is_shelf ? "attenuation_db_per_wavelength = 0.8" : "attenuation_db_per_wavelength = 1.0");
}

/// No port brings an SNR to a vehicle that measures its own.
void leave_out_snr(std::string& text) {
  constexpr std::string_view kRole = "\"snr\", ";
  for (std::size_t at = text.find("\nroles = "); at != std::string::npos; at = text.find("\nroles = ", at + 1)) {
    const std::size_t role = text.find(kRole, at);
    if (role < text.find('\n', at + 1)) text.erase(role, kRole.size());
  }
}

/// A bus of its own.
std::string hydrophone_url(const OwnSearch& search) {
  const std::string url = "udpm://239.255.76.68:7668?ttl=0";
  const host::LcmUrl usual = host::parse_lcm_url(url);
  const host::LcmUrl vehicles = host::parse_lcm_url(search.lcm_url);
  return vehicles.group == usual.group && vehicles.port == usual.port ? "udpm://239.255.76.69:7669?ttl=0" : url;
}

/// For a tone; its noise is learnt beside it, so that the source of ocean.toml, which never pauses, is heard.
std::string hearing_tables(const OwnSearch& search) {
  constexpr double kToEachSide = 0.1;  // of the frequency
  const auto band = [&search](double factor) { return toml_number(std::round(100.0 * factor * search.frequency_hz) / 100.0); };
  return "[[port]]\n"
         "name = \"hydrophone\"\n"
         "kind = \"lcm\"\n"
         "url = \"" +
         hydrophone_url(search) +
         "\"  # of its own, so that its samples cannot crowd out navigation and orders\n"
         "roles = [\"hydrophone\"]\n\n"
         "[hydrophone]                     # the chain from water to numbers, and what is listened for\n"
         "preset = \"continuous_tone\"       # the noise is learnt in the bands beside it, for it never pauses; for calls with pauses "
         "\"fin_whale\", \"blue_whale\",\n"
         "                                 # \"antarctic_blue_whale\", with a band of their own where the two keys are left out\n"
         "band_low_hz = " +
         band(1.0 - kToEachSide) + "\nband_high_hz = " + band(1.0 + kToEachSide) +
         "\n"
         "sensitivity_db_re_1v_per_upa = -180.0  # of the hydrophone, by its data sheet: negative\n"
         "gain_db = 0.0                    # of amplifiers; what gain the blocks name comes on top\n"
         "full_scale_v = 1.0               # at the ADC's input for a sample of 1.0: half of its range from peak to peak\n"
         "adc_bits = 24                    # that carry signal\n"
         "# expected_noise_db_re_1upa = " +
         toml_number(noise_db(search)) +
         " # in the band, where it is known: earshotd --check judges the chain by it, and flow noise is known by it\n\n";
}

/// Three rectangles around the area.
std::string fence_table(const OwnSearch& search) {
  constexpr double kSave = 2.0;
  constexpr double kHalt = 4.0;
  const auto rectangle = [&search](const char* tier, double factor, const char* remark) {
    const double out_m = factor * *search.fence_m;
    const std::string low = toml_number(-out_m);
    const std::string north = toml_number(search.area_north_m + out_m);
    const std::string east = toml_number(search.area_east_m + out_m);
    return std::string(tier) + "_north_m = [" + low + ", " + north + ", " + north + ", " + low + "]  # " + remark + "\n" + tier +
           "_east_m = [" + low + ", " + low + ", " + east + ", " + east + "]\n";
  };
  return "[fence]                          # corners in order, north and east of the origin, in place of the area's edge\n" +
         rectangle("inside", 1.0, "a vehicle that is steered back goes on from here") + rectangle("save", kSave, "steered back from here") +
         rectangle("halt", kHalt, "aborted from here") + "\n";
}

/// What a vehicle takes of its battery only its owner knows: a number that nobody gave would be believed.
std::string consumption(const OwnSearch& search) {
  if (!search.battery_percent_per_km)
    return "# battery_percent_per_km =       # put your vehicle's value here: what a kilometre through the water, at search speed, takes\n"
           "                                 # of its battery; without it nothing states how far that lasts, and earshot fly cannot "
           "simulate "
           "it\n";
  return "battery_percent_per_km = " + toml_number(*search.battery_percent_per_km) +
         "     # through the water, at search speed; earshot fly --battery-percent 100 simulates it\n";
}

std::string battery_rules(const OwnSearch& search) {
  return "[vehicle]                        # fenced_search.toml (firmware/boards/linux/missions) has its other keys\n" +
         consumption(search) +
         "\n"
         "[[rule]]                         # firmware/safety/README.md lists the conditions and what may be done\n"
         "when = \"battery_percent\"\n"
         "below = " +
         toml_number(*search.battery_percent) +
         "\nfor_s = 30.0\n"
         "then = \"abort\"                   # and come up\n\n"
         "[[rule]]                         # the battery is known as long as the vehicle reports it: at sea let this do more than warn\n"
         "when = \"vehicle_status_age_s\"\n"
         "above = 60.0\n"
         "then = \"warn\"\n\n";
}

bool is_battery_simulated(const OwnSearch& search) {
  return search.battery_percent && search.battery_percent_per_km;
}

std::string battery_remark(const OwnSearch& search) {
  if (!search.battery_percent) return "";
  const std::string rule = "\n- The search ends when the battery is below " + toml_number(*search.battery_percent) + " %. ";
  const std::string unreported = "no battery is reported, and the rule about `vehicle_status_age_s` warns of that after a minute.";
  if (is_battery_simulated(search))
    return rule +
           "`earshot fly --battery-percent 100` begins with a full one, of which each kilometre takes the mission's "
           "`battery_percent_per_km`; without that option " +
           unreported;
  return rule +
         "How far it lasts `mission.toml` does not state yet: put there what a kilometre takes of your vehicle's "
         "(`battery_percent_per_km`). "
         "Then "
         "`earshot fly --battery-percent 100` simulates it; until then " +
         unreported;
}

}  // namespace

std::string tables_command(const OwnSearch& search, const fs::path& folder) {
  const auto in_folder = [&folder](const char* name) { return shell_word((folder / name).string()); };
  return command("earshot") + " tables " + in_folder(kOceanFile) + " -o " + in_folder(kTablesFile) + " --key " + in_folder(kKeyFile) +
         " --vehicle-depth-m " + toml_number(search.depth_m) + " --furthest-m " + toml_number(std::ceil(furthest_m(search)));
}

std::string extra_tables(const OwnSearch& search) {
  return (search.hears ? hearing_tables(search) : "") + (search.fence_m ? fence_table(search) : "") +
         (search.battery_percent ? battery_rules(search) : "");
}

std::string mission_text(const OwnSearch& search, FliesBy by) {
  TemplateText mission = shipped_text(kMissions / mission_of(search.bus));
  mission.set_heading(
      "# A search of one's own, made by earshot init: README.md beside it explains how to check and to fly it.\n"
      "# Lengths are metres north and east of the origin, depth is positive down.");
  mission.set("area", "north_m", toml_number(search.area_north_m));
  mission.set("area", "east_m", toml_number(search.area_east_m));
  mission.set("search", "depth_m", toml_number(search.depth_m));
  mission.set("search", "speed_mps", toml_number(search.speed_mps));
  mission.set("search", "source_frequency_hz", toml_number(search.frequency_hz));
  mission.set("limits", "max_depth_m", toml_number(max_depth_m(search)));
  mission.set("limits", "max_time_s", toml_number(max_time_s(search, kStepLength_m, kMaxSteps)));
  mission.set("origin", "latitude_deg", toml_number(search.latitude_deg));
  mission.set("origin", "longitude_deg", toml_number(search.longitude_deg));
  if (search.bus != "can") mission.set("[port]", "url", toml_text(search.lcm_url));
  if (search.bus != "lcm") mission.set("[port]", "interface", toml_text(search.can_interface));
  set_policy(mission, by);
  if (search.hears) mission.set("limits", "snr_timeout_s", "30.0  # longer than the detector is deaf after some lost blocks of sound");
  std::string text = mission.text();
  if (search.hears) leave_out_snr(text);
  if (search.fence_m)
    replace_line(text, "[area]", "[area]                           # way-points lie in it; leaving the [fence] ends the mission");
  text.insert(text.find("[origin]"), extra_tables(search));
  const std::string tables =
      toml_text(by == FliesBy::kWhatShips ? host::shipped("policy/tables/shipped").string() : std::string(kTablesFile));
  // Said in every mission of this program, though those that ship need not be: it is what an own ocean changes next.
  std::string line =
      "tables = " + tables + "  # the oceans that are possible there: a file, or a folder of which one covers depth, frequency and area\n";
  const std::size_t remark = text.find("# tables = ");
  if (remark != std::string::npos) text.erase(remark, text.find('\n', remark) + 1 - remark);
  return text.insert(text.find("public_key_file = "), line);
}

std::string ocean_text(const OwnSearch& search) {
  TemplateText ocean = shipped_text("sim/ocean/environments/munk_flat.toml");
  ocean.set_heading(
      "# The ocean that earshot fly searches in, made by earshot init of the one that ships: a whale calling near the surface.\n"
      "# Every key names its unit; depth is positive down, north and east are metres from the south-west corner of the area.");
  ocean.set("", "name", toml_text("my ocean"));
  ocean.set("source", "frequency_hz", toml_number(search.frequency_hz));
  if (search.sea_floor_m <= 60.0) ocean.set("source", "depth_m", toml_number(search.sea_floor_m / 2.0));
  ocean.set("source", "level_db_re_1upa_at_1m", toml_number(search.source_level_db));
  ocean.set("seabed", "depth_m", toml_number(search.sea_floor_m));
  std::string text = ocean.text();
  constexpr const char* kPlaceCounts = "  # with --source fixed only; otherwise the seed draws the place";
  replace_line(text, "north_m = ", "north_m = " + toml_number(0.4 * search.area_north_m) + kPlaceCounts);
  replace_line(text, "east_m = ", "east_m = " + toml_number(0.4 * search.area_east_m) + kPlaceCounts);
  replace_line(text, "level_db_re_1upa = ", "level_db_re_1upa = " + toml_number(noise_db(search)) + noise_remark(search));
  if (search.sea_floor_m < kLeastForSoundChannel_m) replace_water(text, search.sea_floor_m);
  replace_seabed(text, search.sea_floor_m);
  return text;
}

std::string run_text() {
  return "#!/bin/sh\n"
         "# Flies mission.toml on the vehicle, made by earshot init: what a supervisor starts. Started again after a crash or a power cut, "
         "it goes on\n"
         "# with the mission that its journal holds. It commands nothing before an operator's START. Ctrl-C or SIGTERM ends the search in "
         "order.\n"
         "# Options of earshotd may follow (earshotd --help): ./run --speed 10 is a rehearsal ashore, ten times as fast.\n"
         "# ./run --check only judges the mission, and writes no journal.\n"
         "cd \"$(dirname \"$0\")\" || exit 2\n"
         "case \" $* \" in *\" --check \"*) exec " +
         command("earshotd") + " mission.toml \"$@\" ;; esac\nexec " + command("earshotd") +
         " mission.toml --out journal --resume \"$@\"\n";
}

std::string readme_text(const OwnSearch& search, FliesBy by, const fs::path& folder) {
  const std::string mission = shell_word((folder / kMissionFile).string());
  const bool to_be_made = by == FliesBy::kTablesToBeMade;
  std::string text = "# A search of one's own\n```sh\n" + (to_be_made ? tables_command(search, folder) + "\n" : "") + command("earshotd") +
                     " --check " + mission + "\n" + command("earshot") + " fly --mission " + mission + " --environment " +
                     shell_word((folder / kOceanFile).string()) + " --out " + shell_word((folder / "flight").string()) +
                     (search.bus == "lcm" ? "" : " --bus lcm") + (search.hears ? " --hear synthetic" : "") +
                     (is_battery_simulated(search) ? " --battery-percent 100" : "") + "\n```\n";
  if (to_be_made)
    text +=
        "The first makes `search.tables`, what the vehicle believes possible of the ocean: here `ocean.toml` alone. At sea the ocean is "
        "not known so well: name as many "
        "files as there are oceans that may be true there. It is needed once, and again after a change of depth, area or frequency. ";
  text += std::string(to_be_made ? "The second" : "The first") + " prints what the mission will do, and what may be wrong with it. The " +
          (to_be_made ? "third" : "second") + " flies it in the ocean of `ocean.toml`" + (search.bus == "lcm" ? "" : kOverLcm) +
          " and leaves `flight/report.html`.\n\n"
          "| file | what | change it for |\n|---|---|---|\n"
          "| `mission.toml` | what the vehicle does | where the area lies, depth (within a tenth), speed, limits, bus, rules of safety; "
          "another size of the area, or another depth: `earshot init` again |\n"
          "| `ocean.toml` | what `earshot fly` searches in | water, sea floor, noise, source |\n"
          "| `run` | starts `earshotd` at sea | where its journal goes |\n";
  if (by != FliesBy::kWhatShips)
    text +=
        "| `search.policy` | the policy that ships, for an area of this size | made again by `earshot init` for another size |\n"
        "| `search.tables` | the oceans that the vehicle thinks possible | made again by `earshot tables` |\n"
        "| `search.key`, `search.pub` | sign both; the mission trusts the public half | keep `search.key` off the vehicle |\n";
  text +=
      "\nEvery key of both TOML files has its meaning beside it. After a change, check and fly again.\n\n"
      "- The size of the area must be the policy's, depth (within a tenth) and frequency (within a twentieth) those of its ocean tables: "
      "what does not fit is refused, with "
      "the values that do.\n"
      "- What the vehicle believes possible of the ocean stands in its tables, not in `ocean.toml`.";
  if (by == FliesBy::kWhatShips)
    text += " Those that ship are used here; `earshot init --own-tables` makes a folder for tables of your own.";
  text += battery_remark(search);
  return text + "\n- This folder may be copied to the vehicle" +
         (by == FliesBy::kWhatShips ? "" : ", but for `search.key` (`rsync --exclude search.key`)") +
         ". Change the paths in `run` and `mission.toml` to those of that computer.\n";
}

}  // namespace earshot::own_search
