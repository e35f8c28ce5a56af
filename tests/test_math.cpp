// Powers and exponentials that are ours.
#include "math/real.h"
#include "support.h"

namespace divot::math {
namespace {

double relative(double found, double expected) { return std::abs(found - expected) / std::abs(expected); }

TEST(Math, ExponentialAgreesWithTheLibrarys) {
  test::Random random(1);
  for (int k = 0; k < 20000; ++k) {
    const float x = random.in(-80.0f, 80.0f);
    ASSERT_LT(relative(exponential(x), std::exp(static_cast<double>(x))), 2.5e-7) << x;
  }
  EXPECT_EQ(exponential(0.0f), 1);
  EXPECT_LT(exponential(-1000.0f), 1e-37);
  EXPECT_TRUE(std::isfinite(exponential(1000.0f)));
}

TEST(Math, LogarithmAgreesWithTheLibrarys) {
  test::Random random(2);
  for (int k = 0; k < 20000; ++k) {
    const auto x = static_cast<float>(std::pow(10.0, random.in(-30.0, 30.0)));
    ASSERT_LT(relative(logarithm(x), std::log(static_cast<double>(x))), 2.5e-7) << x;
  }
  EXPECT_EQ(logarithm(1.0f), 0);
}

TEST(Math, PowersAgreeWithTheLibrarys) {
  test::Random random(3);
  for (int k = 0; k < 20000; ++k) {
    const auto x = static_cast<float>(std::pow(10.0, random.in(-6.0, 3.0)));
    const float y = random.in(0.1f, 3.0f);
    const double expected = std::pow(static_cast<double>(x), static_cast<double>(y));
    ASSERT_LT(relative(to_the_power(x, y), expected), 1e-7 * (3 + std::abs(std::log(expected)))) << x << ' ' << y;
  }
  EXPECT_EQ(to_the_power(0.0f, 0.5f), 0);
}

TEST(Math, DoublesAgreeWithTheLibrarysToTheLastDigits) {
  test::Random random(4);
  for (int k = 0; k < 20000; ++k) {
    const double x = random.in(-700.0, 700.0), z = std::pow(10.0, random.in(-9.0, 3.0));
    const float y = random.in(0.1f, 3.0f);
    ASSERT_LT(relative(exponential(x), std::exp(x)), 3e-16) << x;
    const double log = std::log(z), power = std::pow(z, static_cast<double>(y));
    ASSERT_NEAR(logarithm_of_double(z), log, 3e-16 * std::abs(log)) << z;
    ASSERT_LT(relative(to_the_power(z, y), power), 2e-16 * (2 + std::abs(std::log(power)))) << z << ' ' << y;
  }
  EXPECT_EQ(exponential(0.0), 1);
  EXPECT_EQ(logarithm_of_double(1.0), 0);
  EXPECT_EQ(to_the_power(0.0, 0.5f), 0);
  EXPECT_TRUE(std::isfinite(exponential(1e4)));
}

}  // namespace
}  // namespace divot::math
