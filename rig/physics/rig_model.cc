#include "rig/physics/rig_model.h"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "rig/physics/heat_model.h"
#include "rig/physics/noise.h"
#include "rig/physics/random.h"
#include "rig/physics/signal.h"
#include "rig/physics/term.h"

namespace zrobench::physics {
namespace {

// Streams of the seed. Fixed numbers: a new source of randomness must not change the old ones.
enum Stream : std::uint64_t { kGyroWhite = 0, kAccelWhite = 3, kGyroFlicker = 6, kSound = 9 };

template <typename Source, typename... Leading>
std::array<Source, 3> PerAxis(std::uint64_t seed, std::uint64_t first_stream, Leading... leading) {
  return {Source{leading..., seed, first_stream}, Source{leading..., seed, first_stream + 1},
          Source{leading..., seed, first_stream + 2}};
}

}  // namespace

struct RigModel::State {
  State(const Model& model_in, double sample_hz, std::uint64_t seed)
      : model(model_in),
        gyro(model_in.gyro.value_or(GyroModel{})),
        sample_period_s(1 / sample_hz),
        gyro_sigma_dps(WhiteSigma(gyro.noise_density_dps_per_rthz, sample_hz)),
        accel_sigma_g(WhiteSigma(model_in.accel.noise_density_g_per_rthz, sample_hz)),
        heat(model_in),
        gyro_white(PerAxis<RandomStream>(seed, kGyroWhite)),
        accel_white(PerAxis<RandomStream>(seed, kAccelWhite)),
        gyro_flicker(PerAxis<FlickerNoise>(seed, kGyroFlicker, gyro.flicker_dps, sample_hz)),
        sound(PerAxis<RandomStream>(seed, kSound)) {}

  void AddTerms(const Inputs& inputs, Sensed& sensed) {
    TermContext context{inputs, heat.temperatures(), sample_period_s, {}, heat.die_k_per_s(), 1,
                        false};
    if (inputs.tone_band_hz > 0 && inputs.tone_pa > 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        context.normals[axis] = {sound[axis].Normal(), sound[axis].Normal()};
      }
    }
    ActOnSample(heat.terms(), context, heat.states(), sensed);
  }

  Model model;
  GyroModel gyro;
  double sample_period_s;
  double gyro_sigma_dps;
  double accel_sigma_g;
  HeatModel heat;
  Inputs last_inputs;
  std::array<RandomStream, 3> gyro_white;
  std::array<RandomStream, 3> accel_white;
  std::array<FlickerNoise, 3> gyro_flicker;
  std::array<RandomStream, 3> sound;
};

Result<RigModel> RigModel::Make(const Model& model, double sample_hz, std::uint64_t seed) {
  if (Status valid = Validate(model); !valid) return tl::unexpected(valid.error());
  if (!(sample_hz > 0) || !std::isfinite(sample_hz)) {
    return Fail(Error::Kind::kConfig, fmt::format("sample_hz must be > 0, is {}", sample_hz));
  }
  return RigModel(std::make_unique<State>(model, sample_hz, seed));
}

RigModel::RigModel(std::unique_ptr<State> state) : state_(std::move(state)) {}
RigModel::RigModel(RigModel&&) noexcept = default;
RigModel& RigModel::operator=(RigModel&&) noexcept = default;
RigModel::~RigModel() = default;

void RigModel::Reset() { state_->heat.Reset(); }

void RigModel::AdvanceHeat(double dt_s, const Inputs& inputs) {
  state_->heat.Advance(dt_s, inputs);
  state_->last_inputs = inputs;
}

Sensed RigModel::SampleSensors(const Inputs& inputs) {
  State& s = *state_;
  Sensed sensed;
  if (s.model.gyro) {
    const Axes offset_dps = CubicOffset(s.gyro, s.heat.temperatures().die_degc);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sensed.rate_dps[axis] = inputs.turn_dps[axis] + offset_dps[axis] +
                              s.gyro_sigma_dps * s.gyro_white[axis].Normal() +
                              s.gyro_flicker[axis].Next();
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sensed.accel_g[axis] = inputs.gravity_g[axis] + inputs.shake_g[axis] +
                           s.accel_sigma_g * s.accel_white[axis].Normal();
  }
  if (!s.heat.terms().empty()) s.AddTerms(inputs, sensed);
  if (!s.model.gyro) sensed.rate_dps = {};
  return sensed;
}

void RigModel::PowerCycle() { state_->heat.PowerOn(); }

Temperatures RigModel::temperatures() const { return state_->heat.temperatures(); }
Temperatures RigModel::shown_temperatures() const { return state_->heat.shown(); }

Axes RigModel::TrueZro() const {
  State& s = *state_;
  if (!s.model.gyro) return {};
  const Temperatures now = s.heat.temperatures();
  Sensed sensed{CubicOffset(s.gyro, now.die_degc), {}};
  Inputs quiet = s.last_inputs;
  quiet.tone_pa = 0;
  quiet.turn_dps = quiet.shake_g = {};
  const TermContext context{quiet, now, s.sample_period_s, {}, s.heat.die_k_per_s(), 1, true};
  for (const ActiveTerm& term : s.heat.terms()) {
    term.info->term->Output(context, term.parameters, s.heat.StatesOf(term), sensed);
  }
  return sensed.rate_dps;
}

double RigModel::StoredHeat() const { return state_->heat.StoredHeat(); }
double RigModel::NetHeatFlow() const { return state_->heat.NetHeatFlow(); }

}  // namespace zrobench::physics
