// SPDX-License-Identifier: Apache-2.0
// The numbers of the oracle for straight lines: 192 bits, so that the cube root of an error is still none.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace hcsp::straight_line {

using Number = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<192, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

/// What counts as zero beside `scale`: far more than what a computation in Number is wrong by, far less than
/// a double shows.
inline Number negligible(const Number& scale) { return ldexp(scale, -110); }

}  // namespace hcsp::straight_line
