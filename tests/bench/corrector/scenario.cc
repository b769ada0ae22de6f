#include "tests/bench/corrector/scenario.h"

#include <stdexcept>

namespace zrobench::bench {
namespace {

Disturbance SlowTurn(int begin, int every, int length) {
  return {begin, every, length, 0, 1 << 20, {0, 0, 0.5}, 1.0};
}

Disturbance Tone(int begin, int every) {
  return {begin, every, 1, 0, 1 << 20, {0.30, -0.20, 0}, 1.5};
}

Scenario Named(const char* name, const char* about, double rms_mdps = 0.0, double max_mdps = 0.0) {
  Scenario s;
  s.name = name;
  s.about = about;
  s.target_rms_mdps = rms_mdps;
  s.target_max_mdps = max_mdps;
  return s;
}

void AddOffsets(std::vector<Scenario>& all) {
  all.push_back(Named("cycle", "18 to 42 degC and back twice, still 20 s a minute", 3.5, 12));
  all.push_back(Named("quant", "the temperature comes in steps of 1 degC", 8, 25));
  all.back().temp_step_degc = 1.0;
  all.push_back(Named("lag", "the sensor is 20 s behind the gyro", 6, 25));
  all.back().lag_s = 20.0;
  all.push_back(Named("hyst20", "20 mdps of play with temperature", 9, 30));
  all.back().play_half_degc = 2.0;
  all.push_back(Named("flicker", "2 mdps of 1/f noise", 4.5, 18));
  all.back().flicker = true;
  all.push_back(Named("ramp", "3 degC/min, always still", 3.5, 10));
  Scenario& ramp = all.back();
  ramp.duration_s = 600.0;
  ramp.score_from_s = 60.0;
  ramp.ramp_degc_per_s = 0.05;
  ramp.still_s = 60.0;
  ramp.motion_s = 0.0;
}

void AddCorruptions(std::vector<Scenario>& all) {
  all.push_back(Named("slowrot", "every third still turns at 0.5 dps about gravity", 5, 30));
  all.back().disturbances = {SlowTurn(1, 3, 1)};
  all.push_back(Named("slowrot2", "two of twelve stills, in succession, turn"));
  all.back().disturbances = {SlowTurn(10, 12, 2)};
  all.push_back(Named("slowrotlong", "fifteen stills in succession turn"));
  all.back().disturbances = {SlowTurn(40, 1000, 15)};
  all.push_back(
      Named("acoustic", "a tone in every sixth still: +0.3/-0.2 dps, 1.5 x noise", 4, 15));
  all.back().disturbances = {Tone(2, 6)};
  all.push_back(Named("acousticlong", "the tone in every still of a quarter of an hour", 8, 25));
  all.back().disturbances = {Tone(0, 1)};
  all.back().disturbances[0].from_minute = 30;
  all.back().disturbances[0].to_minute = 45;
  all.push_back(Named("step", "the true offset jumps by 0.25 dps at 1 h; max from 3680 s", 28, 20));
  Scenario& step = all.back();
  step.step_dps[0] = 0.20;
  step.step_dps[1] = -0.15;
  step.step_at_s = 3600.0;
  step.score_max_from_s = 3680.0;
}

void AddStore(std::vector<Scenario>& all) {
  all.push_back(Named("yield", "40 stills of 6.5 s, 10 s of motion between"));
  all.back().still_s = 6.5;
  all.back().motion_s = 10.0;
  all.back().duration_s = 40 * 16.5;
  all.push_back(Named("reboot", "orderly, at 3630 s"));
  all.back().reboot_at_s = 3630.0;
  all.push_back(Named("cut", "power cut at 3630 s"));
  all.back().cut_at_s = 3630.0;
}

void AddConditions(std::vector<Scenario>& all) {
  all.push_back(Named("cold", "no factory table"));
  all.back().factory_degc = {};
  all.push_back(Named("coldbad", "no factory table, and the first still turns"));
  all.back().factory_degc = {};
  all.back().disturbances = {SlowTurn(0, 1000, 1)};
  all.push_back(Named("badhour", "every still of the first hour turns"));
  all.back().disturbances = {SlowTurn(0, 1000, 60)};
  all.push_back(Named("tonehour", "the tone in every still of the first hour"));
  all.back().disturbances = {Tone(0, 1)};
  all.back().disturbances[0].to_minute = 60;
  all.push_back(Named("dtdt", "offset + 0.1 dps per degC/s"));
  all.back().rate_dps_s_per_degc = 0.1;
  all.push_back(Named("outside", "-15 to 75 degC from a factory table of 20 to 30"));
  all.back().swing_degc = 45.0;
  all.back().period_s = 7200.0;
  all.push_back(Named("full", "-40 to 85 degC: more bins than the table holds"));
  all.back().mean_degc = 22.5;
  all.back().swing_degc = 62.5;
  all.back().period_s = 7200.0;
  all.push_back(Named("undated", "the date is never known"));
  all.back().date.reset();
  all.push_back(Named("dateback", "the date goes back by a year at 1 h"));
  all.back().date_at_s = 3600.0;
}

void AddFaults(std::vector<Scenario>& all) {
  const auto add = [&all](const char* name, const char* about, Fault fault) {
    all.push_back(Named(name, about));
    all.back().fault = fault;
  };
  add("saturation", "the gyro is at full scale for 50 ms of every 2 s", Fault::kGyroSaturates);
  add("tempstuck", "the temperature repeats one value from 1800 s", Fault::kTemperatureStuck);
  add("gyrostuck", "the gyro repeats one value in the stills of 1800 to 2700 s", Fault::kGyroStuck);
  add("nan", "one sample in 1000 is no number", Fault::kNan);
  add("dropped", "one sample in 1000 never comes", Fault::kDropped);
  add("repeated", "one sample in 1000 comes twice", Fault::kRepeated);
  for (const double hz : {50.0, 400.0}) {
    all.push_back(Named(hz < 100.0 ? "50hz" : "400hz", "another sample rate, same noise density"));
    all.back().sample_hz = hz;
  }
}

}  // namespace

const std::vector<Scenario>& Scenarios() {
  static const std::vector<Scenario> kAll = [] {
    std::vector<Scenario> all;
    AddOffsets(all);
    AddCorruptions(all);
    AddStore(all);
    AddConditions(all);
    AddFaults(all);
    return all;
  }();
  return kAll;
}

const Scenario& FindScenario(const std::string& name) {
  for (const Scenario& s : Scenarios()) {
    if (s.name == name) return s;
  }
  throw std::invalid_argument("no scenario '" + name + "'");
}

}  // namespace zrobench::bench
