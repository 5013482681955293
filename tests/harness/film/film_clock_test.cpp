#include "harness/film/film_clock.hpp"

#include <gtest/gtest.h>

#include "harness/files/bad_input.hpp"
#include "harness/film/film.hpp"

namespace harness {
namespace {

TEST(FilmClock, IsDrivenBySimulatedTime) {
  const FilmClock clock{10.0, 20.0, 5.0, 30};
  EXPECT_EQ(clock.frames(), 61);  // both ends are shown
  EXPECT_DOUBLE_EQ(clock.time_of(0), 10.0);
  EXPECT_DOUBLE_EQ(clock.time_of(60), 20.0);
}

TEST(FilmClock, ShowsAMomentAsOneFrame) { EXPECT_EQ((FilmClock{12.5, 12.5, 1.0, 30}).frames(), 1); }

TEST(FilmClock, ShowsNoFrameBeyondTheEnd) {
  const FilmClock clock{0.0, 0.99, 1.0, 10};
  EXPECT_EQ(clock.frames(), 10);
  EXPECT_LE(clock.time_of(clock.frames() - 1), clock.end);
}

TEST(FilmClock, ChoosesARoundSpeedThatIsFastEnough) {
  EXPECT_EQ(speed_for(0.0, 40.0), 1.0);
  EXPECT_EQ(speed_for(40.0, 40.0), 1.0);
  EXPECT_EQ(speed_for(41.0, 40.0), 2.0);
  EXPECT_EQ(speed_for(180.0, 40.0), 5.0);
  EXPECT_EQ(speed_for(3900.0, 40.0), 100.0);
}

TEST(FilmClock, TakesWhatTheFilmSectionSays) {
  worlds::Film film;
  film.fps = 25;
  film.speed = 3.0;
  const FilmClock clock = film_clock(film, 100.0, 160.0, 10.0, 20.0);
  EXPECT_EQ(clock.start, 110.0);
  EXPECT_EQ(clock.end, 120.0);
  EXPECT_EQ(clock.speed, 3.0);
  EXPECT_EQ(clock.fps, 25);
  EXPECT_EQ(film_clock(film, 100.0, 160.0, {}, 1000.0).end, 160.0);
}

TEST(FilmClock, RefusesTimesThatTheRunDoesNotHave) {
  EXPECT_THROW(film_clock({}, 0.0, 60.0, 61.0, {}), BadInput);
  EXPECT_THROW(film_clock({}, 0.0, 60.0, -1.0, {}), BadInput);
  EXPECT_THROW(film_clock({}, 0.0, 60.0, 30.0, 20.0), BadInput);
}

}  // namespace
}  // namespace harness
