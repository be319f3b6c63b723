/// Tests that ask both integrators the same question:
///
///     using Friction = BothIntegrators;
///     INSTANTIATE_TEST_SUITE_P(By, Friction, both_integrators, integrator_name);
///     TEST_P(Friction, PipeSlides...) { ... integrator() ... }
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "drillstrand/case.hpp"

namespace drillstrand::test {

class BothIntegrators : public testing::TestWithParam<IntegratorKind> {
  protected:
    static IntegratorKind integrator() { return GetParam(); }
    static bool is_leapfrog() { return GetParam() == IntegratorKind::leapfrog; }
};

inline const auto both_integrators =
    testing::Values(IntegratorKind::dormand_prince, IntegratorKind::leapfrog);

inline std::string integrator_label(IntegratorKind integrator) {
    return integrator == IntegratorKind::leapfrog ? "Leapfrog" : "DormandPrince";
}

inline std::string integrator_name(const testing::TestParamInfo<IntegratorKind>& instance) {
    return integrator_label(instance.param);
}

}  // namespace drillstrand::test
