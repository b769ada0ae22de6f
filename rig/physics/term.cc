#include "rig/physics/term.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include "core/check.h"
#include "rig/physics/terms/acoustic_alias.h"
#include "rig/physics/terms/acoustic_harmonics.h"
#include "rig/physics/terms/acoustic_power_compression.h"
#include "rig/physics/terms/acoustic_rectification.h"
#include "rig/physics/terms/acoustic_resonance.h"
#include "rig/physics/terms/acoustic_resonance_drift.h"
#include "rig/physics/terms/gyro_ageing.h"
#include "rig/physics/terms/gyro_backlash.h"
#include "rig/physics/terms/gyro_creep.h"
#include "rig/physics/terms/gyro_g_sensitivity.h"
#include "rig/physics/terms/gyro_hysteresis.h"
#include "rig/physics/terms/gyro_quantisation.h"
#include "rig/physics/terms/gyro_step.h"
#include "rig/physics/terms/gyro_supply.h"
#include "rig/physics/terms/gyro_temperature_curve.h"
#include "rig/physics/terms/gyro_temperature_rate.h"
#include "rig/physics/terms/gyro_vibration_rectification.h"
#include "rig/physics/terms/gyro_warm_up.h"
#include "rig/physics/terms/thermal_ambient_drift.h"
#include "rig/physics/terms/thermal_contact_resistance_temperature.h"
#include "rig/physics/terms/thermal_convection.h"
#include "rig/physics/terms/thermal_dead_time.h"
#include "rig/physics/terms/thermal_die_sensor_hold.h"
#include "rig/physics/terms/thermal_parallel_mass.h"
#include "rig/physics/terms/thermal_peltier_joule.h"
#include "rig/physics/terms/thermal_plate_sensor_gain.h"
#include "rig/physics/terms/thermal_plate_sensor_lag.h"
#include "rig/physics/terms/thermal_radiation.h"
#include "rig/physics/terms/thermal_saturation.h"
#include "rig/physics/terms/thermal_self_heating.h"
#include "rig/physics/terms/thermal_series_mass.h"
#include "rig/physics/terms/time_latency.h"
#include "rig/physics/terms/time_sample_hold.h"

namespace zrobench::physics {
namespace {

/// Levenshtein distance.
std::size_t Distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

void Append(const TermInfo& info, const Model& model, std::vector<double>& flat) {
  const auto stated = model.term.find(std::string(info.id));
  for (const ParameterInfo& parameter : info.parameters) {
    const std::vector<double>* values = &parameter.defaults;
    if (stated != model.term.end()) {
      const auto found = stated->second.find(std::string(parameter.name));
      if (found != stated->second.end()) values = &found->second;
    }
    flat.insert(flat.end(), values->begin(), values->end());
  }
}

}  // namespace

void Term::Place(const Temperatures&, std::span<double>) const {}
void Term::PowerOn(std::span<double>) const {}
void Term::Sound(const TermContext&, std::span<const double>, std::span<double>, Heard&) const {}
void Term::Step(const TermContext&, std::span<const double>, std::span<double>) const {}
void Term::Output(const TermContext&, std::span<const double>, std::span<const double>,
                  Sensed&) const {}
double Term::Drive(const HeatContext&, std::span<const double>, std::span<double>,
                   double drive_pct) const {
  return drive_pct;
}
void Term::Heat(const HeatContext&, std::span<const double>, std::span<double>, HeatFlows&) const {}
void Term::Show(const HeatContext&, std::span<const double>, std::span<double>,
                Temperatures&) const {}

std::span<const TermInfo> Catalogue() {
  static const std::array infos = {AcousticAliasInfo(),
                                   AcousticHarmonicsInfo(),
                                   AcousticPowerCompressionInfo(),
                                   AcousticRectificationInfo(),
                                   AcousticResonanceInfo(),
                                   AcousticResonanceDriftInfo(),
                                   GyroAgeingInfo(),
                                   GyroBacklashInfo(),
                                   GyroCreepInfo(),
                                   GyroGSensitivityInfo(),
                                   GyroHysteresisInfo(),
                                   GyroQuantisationInfo(),
                                   GyroStepInfo(),
                                   GyroSupplyInfo(),
                                   GyroTemperatureCurveInfo(),
                                   GyroTemperatureRateInfo(),
                                   GyroVibrationRectificationInfo(),
                                   GyroWarmUpInfo(),
                                   ThermalAmbientDriftInfo(),
                                   ThermalContactResistanceTemperatureInfo(),
                                   ThermalConvectionInfo(),
                                   ThermalDeadTimeInfo(),
                                   ThermalDieSensorHoldInfo(),
                                   ThermalParallelMassInfo(),
                                   ThermalPeltierJouleInfo(),
                                   ThermalPlateSensorGainInfo(),
                                   ThermalPlateSensorLagInfo(),
                                   ThermalRadiationInfo(),
                                   ThermalSaturationInfo(),
                                   ThermalSelfHeatingInfo(),
                                   ThermalSeriesMassInfo(),
                                   TimeLatencyInfo(),
                                   TimeSampleHoldInfo()};
  return infos;
}

const TermInfo* FindTerm(std::string_view id) {
  const auto infos = Catalogue();
  const auto found = std::ranges::find(infos, id, &TermInfo::id);
  return found == infos.end() ? nullptr : &*found;
}

std::string_view NearestTerm(std::string_view id) {
  return std::ranges::min(Catalogue(), {},
                          [&](const TermInfo& info) { return Distance(id, info.id); })
      .id;
}

std::vector<std::string_view> UnmetNeeds(const TermInfo& info,
                                         std::span<const std::string> columns) {
  const auto met = [&](std::string_view need) {
    for (std::size_t begin = 0; begin <= need.size();) {
      const std::size_t end = std::min(need.find('|', begin), need.size());
      if (std::ranges::find(columns, need.substr(begin, end - begin)) != columns.end()) return true;
      begin = end + 1;
    }
    return false;
  };
  std::vector<std::string_view> unmet;
  std::ranges::remove_copy_if(info.needs, std::back_inserter(unmet), met);
  return unmet;
}

std::vector<double> FlatParameters(const TermInfo& info, const Model& model) {
  std::vector<double> flat;
  Append(info, model, flat);
  for (std::string_view from = info.borrows; !from.empty();) {
    const TermInfo& lender = *FindTerm(from);
    Append(lender, model, flat);
    from = lender.borrows;
  }
  return flat;
}

std::vector<ActiveTerm> ActiveTerms(const Model& model) {
  std::vector<ActiveTerm> active;
  std::size_t states = 0;
  for (const std::string& id : model.terms) {
    const TermInfo* info = FindTerm(id);
    ZROBENCH_CHECK(info != nullptr);
    active.push_back({info, FlatParameters(*info, model), states});
    states += info->states;
  }
  return active;
}

void ActOnSample(std::span<const ActiveTerm> terms, const TermContext& context,
                 std::span<double> all_states, Sensed& sensed) {
  const auto states_of = [&](const ActiveTerm& term) {
    return all_states.subspan(term.first_state, term.info->states);
  };
  Heard heard{context.inputs.tone_pa, context.resonance_scale};
  for (const ActiveTerm& term : terms) {
    term.info->term->Sound(context, term.parameters, states_of(term), heard);
  }
  Inputs inputs = context.inputs;
  inputs.tone_pa = heard.tone_pa;
  const TermContext hears{inputs,          context.temperatures, context.sample_period_s,
                          context.normals, context.die_k_per_s,  heard.resonance_scale,
                          context.truth};
  for (const ActiveTerm& term : terms) {
    term.info->term->Step(hears, term.parameters, states_of(term));
    term.info->term->Output(hears, term.parameters, states_of(term), sensed);
  }
}

}  // namespace zrobench::physics
