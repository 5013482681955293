#include "harness/film/matrix_picture.hpp"

#include <gtest/gtest.h>

namespace harness {
namespace {

using seif::BeliefMatrix;

TEST(MatrixPicture, IsDarkerWhereABlockIsStronger) {
  for (const BeliefMatrix matrix : {BeliefMatrix::information, BeliefMatrix::covariance}) {
    EXPECT_EQ(MatrixPicture::darkness(matrix, 0.0F), 0.0F);
    float last = 0.04F;  // a block that is not zero is not white
    for (const float strength : {1e-6F, 0.01F, 0.1F, 0.5F, 0.9F, 0.99F, 0.999F}) {
      EXPECT_GT(MatrixPicture::darkness(matrix, strength), last) << strength;
      last = MatrixPicture::darkness(matrix, strength);
    }
    EXPECT_FLOAT_EQ(MatrixPicture::darkness(matrix, 1.0F), 1.0F);
  }
}

TEST(MatrixPicture, TellsStrongCorrelationsApart) {
  const auto dark = [](float strength) {
    return MatrixPicture::darkness(BeliefMatrix::covariance, strength);
  };
  EXPECT_LT(dark(0.5F), 0.2F);
  EXPECT_NEAR(dark(0.99F) - dark(0.9F), 0.235F, 0.01F);
  EXPECT_NEAR(dark(0.999F) - dark(0.99F), 0.235F, 0.01F);
  EXPECT_LT(dark(0.999F), 0.8F);
}

TEST(MatrixPicture, ExplainsItsScale) {
  const render::Raster scale = MatrixPicture::scale({0, 0}, {100, 5});
  ASSERT_EQ(scale.rgba.size(), 4U * static_cast<std::size_t>(scale.columns));
  EXPECT_EQ(scale.rgba.front(), 255);
  EXPECT_LT(scale.rgba[scale.rgba.size() - 4], 20);
}

}  // namespace
}  // namespace harness
