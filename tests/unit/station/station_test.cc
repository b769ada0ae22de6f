#include "rig/station/station.h"

#include <gmock/gmock.h>

#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::ElementsAre;

constexpr UtcNs kNewYear2026 = 1'767'225'600'000'000'000;

Station Load(const std::filesystem::path& path) {
  const Result<Station> station = LoadStation(path);
  if (!station) throw std::runtime_error(station.error().message);
  return *station;
}
Station LoadText(const std::string& text) { return Load(TextFile(text).path()); }

TEST(Station, EveryKeyArrives) {
  const Station s = LoadText(R"(
[station]
name = "bench-3"
humidity_pct = 55
purge = true
[instruments]
plate = "modbus-tcp://10.1.1.1:502"
speaker = "scpi-tcp://10.1.1.2:5025"
board = "can:can0"
power = "scpi:/dev/ttyS0"
environment = "modbus-rtu:/dev/ttyS1"
[limits]
min_degc = 5
max_degc = 45
max_rate_degc_per_min = 3
min_tone_hz = 100
max_tone_hz = 30000
max_tone_v = 4
max_spl_db = 110
max_tone_s = 90
[calibration]
certificate = "K-17"
plate_uncertainty_k2_degc = 0.2
speaker_uncertainty_k2_db = 1.5
[clock]
speed = 20
[virtual]
epoch = 2026-03-01T01:00:00+01:00
sample_hz = 100
gyro_range_dps = 500
controller = { kp_pct_per_k = 8, ki_pct_per_k_s = 0.1, rate_limit_degc_per_min = 4 }
factory_degc = [15, 35]
factory_error_dps = 0.01
[model]
terms = ["acoustic.rectification"]
[model.ambient]
degc = 21
[model.plate]
heat_capacity_j_per_k = 300
heater_w = 80
cooler_w = 50
to_ambient_w_per_k = 0.4
resolution_degc = 0.01
[model.board]
heat_capacity_j_per_k = 9
to_plate_w_per_k = 0.7
to_ambient_w_per_k = 0.02
[model.package]
time_constant_s = 6
resolution_degc = 0.5
[model.gyro]
reference_degc = 30
noise_density_dps_per_rthz = 0.01
flicker_dps = 0.002
zro_x_dps = [1, 2, 3, 4]
zro_y_dps = [5, 6]
zro_z_dps = [7]
[model.accel]
noise_density_g_per_rthz = 2e-4
[model.speaker]
pa_per_v = 0.5
[model.term."acoustic.rectification"]
dps_per_pa2 = [0.1, 0.2, 0.3]
[model.term."acoustic.resonance"]
q = 300
)");
  EXPECT_EQ(s.name, "bench-3");
  EXPECT_EQ(s.humidity_pct, 55);
  EXPECT_TRUE(s.purge);
  EXPECT_EQ(s.plate, "modbus-tcp://10.1.1.1:502");
  EXPECT_EQ(s.speaker, "scpi-tcp://10.1.1.2:5025");
  EXPECT_EQ(s.board, "can:can0");
  EXPECT_EQ(s.power, "scpi:/dev/ttyS0");
  EXPECT_EQ(s.environment, "modbus-rtu:/dev/ttyS1");
  EXPECT_FALSE(s.all_virtual());
  EXPECT_EQ(s.limits.min_degc, 5);
  EXPECT_EQ(s.limits.max_degc, 45);
  EXPECT_EQ(s.limits.max_rate_degc_per_min, 3);
  EXPECT_EQ(s.limits.min_tone_hz, 100);
  EXPECT_EQ(s.limits.max_tone_hz, 30000);
  EXPECT_EQ(s.limits.max_tone_v, 4);
  EXPECT_EQ(s.limits.max_spl_db, 110);
  EXPECT_EQ(s.limits.max_tone_s, 90);
  EXPECT_EQ(s.calibration.certificate, "K-17");
  EXPECT_EQ(s.calibration.plate_uncertainty_k2_degc, 0.2);
  EXPECT_EQ(s.calibration.speaker_uncertainty_k2_db, 1.5);
  EXPECT_EQ(s.clock_speed, 20);
  EXPECT_EQ(s.virtual_rig.epoch, kNewYear2026 + 59 * 86'400'000'000'000);
  EXPECT_EQ(s.virtual_rig.sample_hz, 100);
  EXPECT_EQ(s.virtual_rig.gyro_range_dps, 500);
  EXPECT_EQ(s.virtual_rig.kp_pct_per_k, 8);
  EXPECT_EQ(s.virtual_rig.ki_pct_per_k_s, 0.1);
  EXPECT_EQ(s.virtual_rig.rate_limit_degc_per_min, 4);
  EXPECT_THAT(s.virtual_rig.factory_degc, ElementsAre(15, 35));
  EXPECT_EQ(s.virtual_rig.factory_error_dps, 0.01);
  const physics::Model& m = s.model;
  EXPECT_EQ(m.ambient_degc, 21);
  EXPECT_EQ(m.plate.heat_capacity_j_per_k, 300);
  EXPECT_EQ(m.plate.heater_w, 80);
  EXPECT_EQ(m.plate.cooler_w, 50);
  EXPECT_EQ(m.plate.to_ambient_w_per_k, 0.4);
  EXPECT_EQ(m.plate.resolution_degc, 0.01);
  EXPECT_EQ(m.board->heat_capacity_j_per_k, 9);
  EXPECT_EQ(m.board->to_plate_w_per_k, 0.7);
  EXPECT_EQ(m.board->to_ambient_w_per_k, 0.02);
  EXPECT_EQ(m.package->time_constant_s, 6);
  EXPECT_EQ(m.package->resolution_degc, 0.5);
  EXPECT_EQ(m.gyro->reference_degc, 30);
  EXPECT_EQ(m.gyro->noise_density_dps_per_rthz, 0.01);
  EXPECT_EQ(m.gyro->flicker_dps, 0.002);
  EXPECT_THAT(m.gyro->zro_dps[0], ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(m.gyro->zro_dps[1], ElementsAre(5, 6, 0, 0));
  EXPECT_THAT(m.gyro->zro_dps[2], ElementsAre(7, 0, 0, 0));
  EXPECT_EQ(m.accel.noise_density_g_per_rthz, 2e-4);
  EXPECT_EQ(m.speaker.pa_per_v, 0.5);
  EXPECT_THAT(m.terms, ElementsAre("acoustic.rectification"));
  EXPECT_THAT(m.term.at("acoustic.rectification").at("dps_per_pa2"), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_THAT(m.term.at("acoustic.resonance").at("q"), ElementsAre(300));
}

TEST(Station, WithoutInstrumentsEverythingIsVirtual) {
  const Station s = LoadText("station.name = \"s\"\n");
  EXPECT_TRUE(s.all_virtual());
  EXPECT_EQ(s.power, "virtual:");
}

TEST(Station, ABenchHasOnlyTheInstrumentsItNames) {
  const Station s =
      LoadText("station.name = \"s\"\n[instruments]\nplate = \"virtual:\"\nboard = \"virtual:\"\n");
  EXPECT_EQ(s.speaker, "");
  EXPECT_EQ(s.power, "");
  EXPECT_TRUE(s.all_virtual());
}

TEST(Station, StatesWithoutATableDoNotExist) {
  const Station s = LoadText("station.name = \"s\"\n[model.board]\n");
  EXPECT_TRUE(s.model.board);
  EXPECT_FALSE(s.model.package);
  EXPECT_FALSE(s.model.gyro);
  const Station none = LoadText("station.name = \"s\"\n");
  EXPECT_FALSE(none.model.board);
}

TEST(Station, EpochMayBeADateADateTimeOrAText) {
  const std::string head = "station.name = \"s\"\n[virtual]\nepoch = ";
  for (const char* epoch :
       {"2026-01-01", "2026-01-01T00:00:00Z", "2026-01-01T00:00:00", "\"2026-01-01\"",
        "\"2026-01-01T00:00:00Z\"", "2025-12-31T22:30:00-01:30"}) {
    EXPECT_EQ(LoadText(head + epoch + "\n").virtual_rig.epoch, kNewYear2026) << epoch;
  }
}

TEST(Station, TheShippedStationIsTheDesignsModel) {
  const std::filesystem::path path =
      std::filesystem::path(ZROBENCH_SOURCE_DIR) / "profiles/stations/virtual.toml";
  const Station s = Load(path);
  EXPECT_TRUE(s.all_virtual());
  EXPECT_EQ(s.virtual_rig.epoch, kNewYear2026);
  EXPECT_EQ(s.virtual_rig.sample_hz, 200);
  EXPECT_THAT(s.virtual_rig.factory_degc, ElementsAre(10, 25, 40));
  EXPECT_THAT(s.model.terms, ElementsAre("acoustic.resonance", "acoustic.rectification",
                                         "acoustic.alias", "gyro.ageing", "thermal.self_heating"));
  // The code's defaults and the file's figures are the same nominal rig.
  const physics::Model nominal;
  EXPECT_EQ(s.model.gyro->zro_dps, nominal.gyro->zro_dps);
  EXPECT_EQ(s.model.plate.heater_w, nominal.plate.heater_w);
  EXPECT_EQ(s.model.board->to_plate_w_per_k, nominal.board->to_plate_w_per_k);
  EXPECT_EQ(s.text.substr(0, 17), "# The virtual rig");
  EXPECT_EQ(s.path, path);
}

}  // namespace
}  // namespace zrobench
