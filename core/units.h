#pragma once
// Conversions live here and nowhere else. Names that leave a function carry their unit.
#include <cmath>

namespace zrobench {

inline constexpr double kKelvinOffset = 273.15;
inline constexpr double kStandardGravityMps2 = 9.80665;  ///< CGPM 1901
inline constexpr double kReferencePressurePa = 20e-6;    ///< dB SPL is re 20 uPa rms (IEC 61672-1)

constexpr double MdpsFromDps(double dps) { return dps * 1e3; }
constexpr double DpsFromMdps(double mdps) { return mdps * 1e-3; }
/// rms pressure [Pa] of a sound pressure level [dB SPL].
inline double PaFromSplDb(double spl_db) {
  return kReferencePressurePa * std::pow(10.0, spl_db / 20.0);
}
inline double SplDbFromPa(double pa) { return 20.0 * std::log10(pa / kReferencePressurePa); }

}  // namespace zrobench
