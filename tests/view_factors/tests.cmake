# SPDX-License-Identifier: MIT
# View factors, against closed forms and sums that must be 1.
shaftcull_test(view_factors
  view_factors/closed_forms.cpp
  view_factors/enclosures.cpp
  view_factors/errors.cpp
  view_factors/matrix.cpp
  view_factors/properties.cpp)
