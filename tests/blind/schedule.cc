#include "tests/blind/schedule.h"

#include <algorithm>
#include <cmath>

namespace zrobench::blind {
namespace {

// Lays set points down from a cursor on; what is beyond the end of the run falls away.
class Pen {
 public:
  Pen(Eigen::VectorXd& line, int at) : line_(line), at_(at) {}
  bool Full() const { return at_ >= kRunRows; }
  void Hold(double degc, int seconds) {
    for (int i = 0; i < seconds && !Full(); ++i) line_[at_++] = degc;
    last_ = degc;
  }
  void Ramp(double to_degc, double degc_per_min) {
    const int seconds =
        std::max(1, static_cast<int>(std::abs(to_degc - last_) * 60 / degc_per_min));
    const double from = last_;
    for (int i = 1; i <= seconds && !Full(); ++i) {
      line_[at_++] = from + (to_degc - from) * i / seconds;
    }
    last_ = to_degc;
  }
  void At(double degc) { last_ = degc; }

 private:
  Eigen::VectorXd& line_;
  int at_;
  double last_ = 0;
};

void Steps(Pen& pen, Draw& draw) {
  const double high = draw.Uniform(45, 55);
  const double low = draw.Uniform(8, 14);
  const double mid = draw.Uniform(28, 34);
  for (const double degc : {high, low, mid, high - 5}) pen.Hold(degc, 1500 + draw.Below(300));
  pen.Hold(low + 4, kRunRows);
}

void Triangles(Pen& pen, Draw& draw) {
  const double low = draw.Uniform(10, 14);
  const double high = draw.Uniform(44, 52);
  const double slow = draw.Uniform(1.4, 1.8);
  pen.Ramp(high, slow);
  pen.Ramp(low, slow);
  while (!pen.Full()) {
    pen.Ramp(high, 4 * slow);
    pen.Ramp(low, 4 * slow);
  }
}

void Staircase(Pen& pen, Draw& draw) {
  const double rise = draw.Uniform(5, 8);
  double degc = draw.Uniform(10, 14);
  double direction = rise;
  while (!pen.Full()) {
    pen.Hold(degc, 380 + draw.Below(120));
    if (degc + direction > 56 || degc + direction < 9) direction = -direction;
    degc += direction;
  }
}

void RandomSteps(Pen& pen, Draw& draw) {
  while (!pen.Full()) pen.Hold(draw.Uniform(9, 55), 120 + draw.Below(480));
}

void DrawSupply(Schedule& run, Draw& draw) {
  for (int at = 900; at < kRunRows; at += 300 + draw.Below(900)) {
    const double volt = 3.3 + 0.1 * (draw.Below(7) - 3);
    run.supply_v.tail(kRunRows - at).setConstant(volt);
  }
}

void DrawTones(Schedule& run, const Bench& bench, Draw& draw) {
  const Axes& hz = bench.nominal.resonance_hz;
  for (int at = 300 + draw.Below(300); at < kRunRows - 120; at += 180 + draw.Below(300)) {
    const double choices[] = {hz[0],      hz[1],     hz[2],     hz[2] + 15,
                              hz[2] - 15, hz[2] / 3, hz[0] / 3, 20000};
    const double tone = std::round(choices[draw.Below(8)]);
    const double spl_db = draw.Below(2) ? 94 : 103;
    run.tone_hz.segment(at, 60).setConstant(tone);
    run.tone_spl_db.segment(at, 60).setConstant(spl_db);
  }
}

void DrawMotion(Schedule& run, Draw& draw) {
  for (int at = 1200 + draw.Below(600); at < kRunRows - 400; at += 1500 + draw.Below(1200)) {
    run.vibration_g.segment(at, 120).setConstant(draw.Below(2) ? 0.5 : 1.0);
  }
  run.gravity_g.col(2).setOnes();
  const int turned = 3000 + draw.Below(1000);
  const int back = turned + 1200 + draw.Below(600);
  const int axis = draw.Below(2);
  run.gravity_g.block(turned, 2, back - turned, 1).setZero();
  run.gravity_g.block(turned, axis, back - turned, 1).setConstant(draw.Sign());
  run.moving.segment(turned, 12).setOnes();
  run.moving.segment(back, 12).setOnes();
}

Schedule Blank(double ambient_degc) {
  Schedule run;
  run.setpoint_degc = Eigen::VectorXd::Constant(kRunRows, ambient_degc);
  run.supply_v = Eigen::VectorXd::Constant(kRunRows, 3.3);
  for (Eigen::VectorXd* line : {&run.tone_hz, &run.tone_spl_db, &run.vibration_g, &run.moving}) {
    *line = Eigen::VectorXd::Zero(kRunRows);
  }
  run.gravity_g = Eigen::MatrixXd::Zero(kRunRows, 3);
  return run;
}

}  // namespace

std::vector<Schedule> DrawSchedules(Draw draw, const Bench& bench) {
  using Kind = void (*)(Pen&, Draw&);
  std::vector<Kind> kinds = {Steps, Triangles, Staircase, RandomSteps};
  for (int i = 3; i > 0; --i) {
    std::swap(kinds[static_cast<std::size_t>(i)],
              kinds[static_cast<std::size_t>(draw.Below(i + 1))]);
  }
  std::vector<Schedule> runs;
  double started_h = 0;
  for (const Kind kind : kinds) {
    Schedule run = Blank(bench.nominal.ambient_degc);
    run.started_h = started_h;
    started_h += std::round(draw.Uniform(30, 120)) / 10;
    Pen pen(run.setpoint_degc, 600 + draw.Below(300));
    pen.At(bench.nominal.ambient_degc);
    kind(pen, draw);
    DrawSupply(run, draw);
    DrawTones(run, bench, draw);
    DrawMotion(run, draw);
    runs.push_back(std::move(run));
  }
  return runs;
}

double TonePressure_pa(const Schedule& schedule, int row) {
  return schedule.tone_hz[row] > 0 ? 20e-6 * std::pow(10, schedule.tone_spl_db[row] / 20) : 0;
}

}  // namespace zrobench::blind
