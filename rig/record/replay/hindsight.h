#pragma once
#include <array>
#include <vector>

namespace zrobench {

/// What a polynomial in temperature leaves when it is fitted, afterwards, to every reading at once:
/// a curve that nobody could have had in the field, beside the corrector's causal error.
class Hindsight {
 public:
  void Add(double degc, const float reading_dps[3]) {
    degc_.push_back(degc);
    for (std::size_t i = 0; i < 3; ++i) reading_dps_[i].push_back(double{reading_dps[i]});
  }
  /// rms over all readings about the least-squares polynomial of that degree (0 = their mean).
  /// 0 when there are no more readings than coefficients.
  double rms_mdps(std::size_t axis, int degree) const;

 private:
  std::vector<double> degc_;
  std::array<std::vector<double>, 3> reading_dps_;
};

}  // namespace zrobench
