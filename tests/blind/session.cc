#include "tests/blind/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/blind/pink.h"

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd Drafts(const Instruments& noise, Draw& draw) {
  const double keep = std::exp(-1 / noise.draft_s);
  const double push = noise.draft_k * std::sqrt(1 - keep * keep);
  VectorXd draft(kRunRows);
  double state = draw.Normal(noise.draft_k);
  for (Index row = 0; row < kRunRows; ++row) {
    draft[row] = state;
    state = state * keep + draw.Normal(push);
  }
  return draft;
}

// Proportional and integral, limited in size and slew; looks at its own plate register.
class Loop {
 public:
  Loop(const Instruments& settings, const VectorXd& setpoint_degc, Draw& draw)
      : settings_(settings), setpoint_degc_(setpoint_degc), draw_(draw) {}

  double operator()(int row, double plate_degc) {
    if (row % settings_.controller_period_s != 0) return command_;
    const double seen =
        Register(plate_degc + draw_.Normal(settings_.plate_noise_k), settings_.plate_step_k);
    const double error = setpoint_degc_[row] - seen;
    const double period = settings_.controller_period_s;
    const double wanted = settings_.controller_pct_per_k * error + integral_;
    const double slew = settings_.controller_slew_pct_per_s * period;
    const double next =
        std::clamp(std::clamp(wanted, command_ - slew, command_ + slew), -100.0, 100.0);
    // Integrates only where the command follows: no wind-up in the limits.
    if (std::abs(next - wanted) < 1e-9) {
      integral_ += settings_.controller_pct_per_k_s * period * error;
    }
    command_ = Register(next, 0.01);
    return command_;
  }

 private:
  const Instruments& settings_;
  const VectorXd& setpoint_degc_;
  Draw& draw_;
  double command_ = 0;
  double integral_ = 0;
};

// Four readings a row through a register, some of them the same one when it is renewed slowly.
VectorXd Readings(const VectorXd& felt, const VectorXd& lag_s, double hold_s, double sigma,
                  double step, Draw& draw) {
  VectorXd noise(kRunRows * kSubsteps);
  for (double& value : noise) value = draw.Normal(sigma);
  VectorXd means = VectorXd::Zero(kRunRows);
  for (Index row = 0; row < kRunRows; ++row) {
    for (int sub = 0; sub < kSubsteps; ++sub) {
      const double at = static_cast<double>(row) + (sub + 0.5) * kSubstep_s - lag_s[row];
      const double taken = RenewedAt_s(at, hold_s);
      const auto index =
          std::clamp<Index>(static_cast<Index>(taken * kSubsteps), 0, noise.size() - 1);
      means[row] += Register(ReadAt(felt, taken) + noise[index], step) / kSubsteps;
    }
  }
  return means;
}

// `measured` are means of the second before `row`; set point and tone hold from it on.
std::string Line(const Schedule& schedule, Index row, const std::string& measured) {
  const Index next = std::min<Index>(row, kRunRows - 1);
  return fmt::format("{},{:.2f},{},{:.1f},{:.1f}\n", row, schedule.setpoint_degc[next], measured,
                     schedule.tone_hz[next], schedule.tone_spl_db[next]);
}

std::string Cubic(const std::array<double, 4>& b) {
  return fmt::format("[{:.5f}, {:.6f}, {:.4e}, {:.4e}]", b[0], b[1], b[2], b[3]);
}

std::string Triple(const Axes& axes) {
  return fmt::format("[{}, {}, {}]", axes[0], axes[1], axes[2]);
}

std::string AcousticText(const Bench& bench) {
  const BaseModel& model = bench.nominal;
  std::string text = fmt::format(
      "\n[model.term.\"acoustic.resonance\"]\nresonance_hz = {}\nq = {:.1f}\n"
      "mode_split_hz = 1373.0\ninjection_dps_per_pa = [0.06, 0.08, 0.15]\n",
      Triple(model.resonance_hz), model.resonance_q);
  if (bench.knows_rectification) {
    text += fmt::format("\n[model.term.\"acoustic.rectification\"]\ndps_per_pa2 = {}\n",
                        Triple(model.rectification_dps_per_pa2));
  }
  return text;
}

}  // namespace

double Register(double value, double step) { return step * std::round(value / step); }

Paths CloseLoop(const Bench& bench, const std::vector<Schedule>& schedules,
                const std::vector<Effect>& effects, std::uint64_t seed) {
  Paths paths;
  Draw controller(seed, "controller");
  Draw air(seed, "drafts");
  for (const Schedule& schedule : schedules) {
    const VectorXd draft = Drafts(bench.instruments, air);
    Loop loop(bench.instruments, schedule.setpoint_degc, controller);
    paths.push_back(RunThermal(bench.actual, bench.solids, effects, std::ref(loop), draft));
  }
  return paths;
}

std::string LogText(const Bench& bench, const Schedule& schedule, const Rows& felt,
                    const VectorXd& command_pct, const std::vector<Effect>& effects, Draw draw) {
  const Instruments& noise = bench.instruments;
  const VectorXd none = VectorXd::Zero(kRunRows);
  const VectorXd lag = BoardLag_s(effects);
  const VectorXd plate = Readings(felt.plate_degc, none, StrengthOf(effects, "time.sample_hold"),
                                  noise.plate_noise_k, noise.plate_step_k, draw);
  const VectorXd die = Readings(felt.die_degc, lag, StrengthOf(effects, "thermal.die_sensor_hold"),
                                noise.die_noise_k, noise.die_step_k, draw);
  const Rows shown = Sampled(felt, effects);
  Eigen::MatrixXd gyro = shown.gyro_dps;
  const double gyro_sigma = noise.gyro_density_dps_per_rthz / std::sqrt(2.0);
  const double accel_sigma = noise.accel_density_g_per_rthz / std::sqrt(2.0);
  std::string text =
      "t_s,setpoint_degc,plate_degc,drive_pct,imu_degc,gyro_x_dps,gyro_y_dps,gyro_z_dps,"
      "accel_x_g,accel_y_g,accel_z_g,supply_v,tone_hz,tone_spl_db\n";
  text += Line(schedule, 0, ",,,,,,,,,");
  for (Index axis = 0; axis < 3; ++axis) {
    gyro.col(axis).array() += draw.Normal(noise.power_on_dps);
    gyro.col(axis) += PinkNoise(draw, kRunRows, noise.flicker_dps);
    for (double& value : gyro.col(axis)) value += draw.Normal(gyro_sigma);
  }
  for (Index row = 0; row < kRunRows; ++row) {
    std::string board = fmt::format("{:.4f}", die[row]);
    for (Index axis = 0; axis < 3; ++axis) board += fmt::format(",{:.6f}", gyro(row, axis));
    // A second's mean of broadband shaking, 50 Hz wide, keeps a tenth of its rms.
    const double sigma = std::hypot(accel_sigma, 0.1 * schedule.vibration_g[row]);
    for (Index axis = 0; axis < 3; ++axis) {
      board += fmt::format(",{:.5f}", schedule.gravity_g(row, axis) + draw.Normal(sigma));
    }
    if (schedule.moving[row] > 0) board = ",,,,,,";
    text += Line(schedule, row + 1,
                 fmt::format("{:.3f},{:.2f},{},{:.3f}", plate[row], command_pct[row], board,
                             schedule.supply_v[row]));
  }
  return text;
}

std::string StationText(const Bench& bench, const std::vector<Schedule>& schedules) {
  const BaseModel& m = bench.nominal;
  const Instruments& noise = bench.instruments;
  std::string text =
      "schema = 1\n\n[station]\nname = \"bench\"\n\n[instruments]\nplate = \"virtual:\"\n"
      "speaker = \"virtual:\"\nboard = \"virtual:\"\n\n[recording]\nrows = \"mean\"\n"
      "t0 = \"power_on\"\n\n[recording.started_h]\n";
  for (std::size_t run = 0; run < schedules.size(); ++run) {
    text += fmt::format("run-{} = {:.1f}\n", run + 1, schedules[run].started_h);
  }
  text += fmt::format("\n[model]\nterms = [\"acoustic.resonance\"{}]\n",
                      bench.knows_rectification ? ", \"acoustic.rectification\"" : "");
  text += fmt::format("\n[model.ambient]\ndegc = {:.1f}\n", m.ambient_degc);
  text += fmt::format(
      "\n[model.plate]\nheat_capacity_j_per_k = {:.1f}\nheater_w = {:.1f}\ncooler_w = {:.1f}\n"
      "to_ambient_w_per_k = {:.3f}\nresolution_degc = {:.1f}\n",
      m.plate_j_per_k, m.heater_w, m.cooler_w, m.plate_to_ambient_w_per_k, noise.plate_step_k);
  text += fmt::format(
      "\n[model.board]\nheat_capacity_j_per_k = {:.2f}\nto_plate_w_per_k = {:.3f}\n"
      "to_ambient_w_per_k = {:.4f}\n\n[model.package]\ntime_constant_s = {:.2f}\n"
      "resolution_degc = {:.8f}\n",
      m.board_j_per_k, m.board_to_plate_w_per_k, m.board_to_ambient_w_per_k, m.package_s,
      noise.die_step_k);
  text += fmt::format(
      "\n[model.gyro]\nreference_degc = {:.1f}\nnoise_density_dps_per_rthz = 0.005\n"
      "flicker_dps = 0.001\nzro_x_dps = {}\nzro_y_dps = {}\nzro_z_dps = {}\n",
      kReferenceDegc, Cubic(m.zro_dps[0]), Cubic(m.zro_dps[1]), Cubic(m.zro_dps[2]));
  text += fmt::format("\n[model.accel]\nnoise_density_g_per_rthz = {:.4e}\n",
                      noise.accel_density_g_per_rthz);
  text += "\n[model.speaker]\npa_per_v = 1.0\n";
  return text + AcousticText(bench);
}

}  // namespace zrobench::blind
