#include "words/units.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <numbers>

namespace zwang::lang {
namespace {

struct Measure {
  const char* text;
  double value;  ///< SI, from the definition of the unit
  Dimension dimension;
};

class Quantities : public testing::TestWithParam<Measure> {};

TEST_P(Quantities, have_the_si_value_of_their_definition) {
  const QuantityResult result = parse_quantity(GetParam().text);
  ASSERT_EQ(result.error, QuantityError::none) << GetParam().text;
  EXPECT_DOUBLE_EQ(result.quantity.value, GetParam().value) << GetParam().text;
  EXPECT_EQ(result.quantity.dimension, GetParam().dimension) << GetParam().text;
}

constexpr double degree = std::numbers::pi / 180.0;

INSTANTIATE_TEST_SUITE_P(
    Known, Quantities,
    testing::Values(Measure{"0.08 m/s", 0.08, dimension::velocity},
                    Measure{"36 km/h", 10.0, dimension::velocity}, Measure{"-5 cm", -0.05, dimension::length},
                    Measure{"+2.5 mm", 0.0025, dimension::length},
                    Measure{"90 deg", 90 * degree, dimension::angle},
                    Measure{"0.5 deg/s", 0.5 * degree, dimension::angular_velocity},
                    Measure{"2 kN", 2000.0, dimension::force}, Measure{"20 N m", 20.0, dimension::torque},
                    Measure{"3 N*m", 3.0, dimension::torque}, Measure{"100 kN/m", 1e5, dimension::stiffness},
                    Measure{"13.5 kg mm^2", 13.5e-6, dimension::inertia},
                    Measure{"4 Hz", 4.0, dimension::frequency}, Measure{"4 1/s", 4.0, dimension::frequency},
                    Measure{"2 s^-1", 2.0, dimension::frequency}, Measure{"20 ms", 0.02, dimension::time},
                    Measure{"5 min", 300.0, dimension::time}, Measure{"250 g", 0.25, dimension::mass},
                    Measure{"80 %", 0.8, dimension::none}, Measure{"26", 26.0, dimension::none},
                    Measure{"1e-3 m", 1e-3, dimension::length}, Measure{"200N", 200.0, dimension::force},
                    Measure{"1 m/s/s", 1.0, dimension::acceleration},
                    Measure{"0.01 N m s/rad", 0.01, dimension::angular_damping}),
    [](const auto& test_case) { return "case_" + std::to_string(test_case.index); });

TEST(Quantity, refuses_what_is_no_decimal_number_with_a_unit) {
  for (const char* text : {"", "N", "nan N", "inf", "0x10 m", "1,5 m", "--1 m", "1..2 m", ". m", "$x"}) {
    EXPECT_NE(parse_quantity(text).error, QuantityError::none) << text;
  }
  EXPECT_EQ(parse_quantity("1e999 m").error, QuantityError::too_large);
  EXPECT_EQ(parse_quantity("1e300 km").error, QuantityError::too_large);
}

TEST(Quantity, refuses_unknown_and_ambiguous_units) {
  for (const char* text : {"3 m/s @ 5", "20 degC", "3 rpm", "1 kg/m s", "1 m/", "1 /s", "1 m^0", "1 m^9",
                           "1 m^", "1 m//s", "1 m s^2.5", "1 2 m"}) {
    EXPECT_EQ(parse_quantity(text).error, QuantityError::unknown_unit) << text;
  }
}

TEST(Quantity, names_the_unit_that_was_meant) {
  EXPECT_EQ(nearest_unit("Nm"), "N m");
  EXPECT_EQ(nearest_unit("n"), "N");
  EXPECT_EQ(nearest_unit("sec"), "s");
  EXPECT_EQ(nearest_unit("s2"), "s^2");
  EXPECT_EQ(nearest_unit("degrees"), "deg");
  EXPECT_EQ(nearest_unit("furlong"), "");
}

TEST(Quantity, does_not_read_the_locale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // absent on some machines: then the test says little, but holds
  EXPECT_DOUBLE_EQ(parse_quantity("1.234 m").quantity.value, 1.234);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Dimension, is_described_in_words) {
  EXPECT_EQ(describe(dimension::velocity), "a velocity");
  EXPECT_EQ(describe(dimension::force * dimension::time), "a quantity in kg m s^-1");
}

}  // namespace
}  // namespace zwang::lang
