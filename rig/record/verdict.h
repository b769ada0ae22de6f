#pragma once
// What was measured and how it was judged: plain data, shared by checks, run.json and reports.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace zrobench {

/// Outcome of one check or of a run, worst last.
enum class Verdict : std::uint8_t {
  kPass,
  kMarginal,      ///< inside the limits, but within the uncertainty of one
  kInconclusive,  ///< the evidence does not allow a judgement
  kFail,          ///< the device is at fault
  kRigError,      ///< the rig is at fault: never blamed on the device
};

/// One measured value with everything needed to judge it again.
struct Measurement {
  std::string name;  ///< dotted, stable: "table_accuracy.25.x"
  double value = 0;  ///< in `unit`
  std::string unit;  ///< "mdps", "degc", "1"
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double uncertainty_k2 = 0;                ///< expanded (k = 2), same unit; 0 = exact (counts)
  std::uint64_t first_us = 0, last_us = 0;  ///< evidence: range of record.ulg
};

struct CheckResult {
  std::string check;  ///< name of the check
  std::string about;  ///< one line: what was asked
  Verdict verdict = Verdict::kInconclusive;
  std::string reason;  ///< why it is not a pass; empty for a clean pass
  std::vector<Measurement> measurements;
};

}  // namespace zrobench
