#pragma once

namespace zrobench {

/// Temperature at which air of `ambient_degc` and `humidity_pct` (relative, 0..100) condenses.
/// Magnus formula over water with Sonntag's constants (Z. Meteorol. 40, 1990), good to 0.1 degC
/// from -45 to 60 degC. -273.15 for perfectly dry air.
double DewPoint_degc(double ambient_degc, double humidity_pct);

}  // namespace zrobench
