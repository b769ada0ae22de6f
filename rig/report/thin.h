#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace zrobench {

/// At most about `max_rows` of `rows` (column 0 is time): of each stretch the first row, the first
/// with a gap (NaN), and those where a column has its least and its greatest value. So no extreme
/// and no gap is lost to the eye. Order is kept; few rows are returned as they are.
template <std::size_t N>
std::vector<std::array<double, N>> Thinned(const std::vector<std::array<double, N>>& rows,
                                           std::size_t max_rows) {
  if (rows.size() <= max_rows) return rows;
  const std::size_t stretches = std::max<std::size_t>(1, max_rows / (2 * N));
  std::vector<std::array<double, N>> out;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * rows.size() / stretches;
    const std::size_t end = (s + 1) * rows.size() / stretches;
    std::set<std::size_t> kept{begin};
    for (std::size_t column = 1; column < N; ++column) {
      std::size_t least = begin, greatest = begin, gap = end;
      for (std::size_t i = begin; i < end; ++i) {
        const double value = rows[i][column];
        if (std::isnan(value)) gap = std::min(gap, i);
        if (!(value >= rows[least][column])) least = std::isnan(value) ? least : i;
        if (!(value <= rows[greatest][column])) greatest = std::isnan(value) ? greatest : i;
      }
      kept.insert({least, greatest});
      if (gap < end) kept.insert(gap);
    }
    for (const std::size_t i : kept) out.push_back(rows[i]);
  }
  return out;
}

}  // namespace zrobench
