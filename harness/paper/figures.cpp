#include "harness/paper/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "harness/figures/palette.hpp"
#include "harness/paper/paper.hpp"
#include "harness/statistics/ellipse.hpp"

namespace harness {

namespace {

constexpr double enlargement = 5.0;  // [-] of errors and ellipses, which would be too small to see
constexpr double sigmas = 2.0;       // [-]
constexpr int panel = 300;           // [px]
constexpr double margin = 1.5;       // [m] around the landmarks
constexpr double faintest = 0.12;    // [-] share of its colour that the weakest link keeps

// The settings of all panels. A map has equal axes. In a matrix dark entries are strong; where nearly all
// entries are weak, the square root of an entry gives its darkness.
constexpr const char* settings =
    "set style fill transparent solid 0.15\n"
    "set palette defined (0 'white', 1 'black')\nset cbrange [0:1]\nunset colorbox\n"
    "set tmargin 2\nset bmargin 1.5\nset lmargin 4\nset rmargin 1\nset tics scale 0.4 font ',8'\n"
    "set border lc '#888888'\nset tics textcolor '#333333'\nset key off\n";

/// The colour mixed with white; `share` is the share of the colour.
Rgb faded(Rgb colour, double share) {
  Rgb result = 0;
  for (const int shift : {0, 8, 16}) {
    const double channel = 255.0 - share * (255.0 - static_cast<double>((colour >> shift) & 0xFF));
    result |= static_cast<Rgb>(std::lround(channel)) << shift;
  }
  return result;
}

struct Mark {
  Eigen::Vector2d truth;
  Eigen::Vector2d error;       // estimate minus truth
  Eigen::Matrix2d covariance;  // of the error
};

/// Writes one line: truth, error, and the full axes and the angle [deg] of the ellipse. Error and ellipse are
/// enlarged.
void append_mark(const Mark& mark, std::string& text) {
  const Eigen::Matrix2d axes = 2 * enlargement * ellipse_axes(mark.covariance, sigmas);
  const Eigen::Vector2d error = enlargement * mark.error;
  const Eigen::Vector2d major = axes.col(1);
  fmt::format_to(std::back_inserter(text), "{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.2f}\n",
                 mark.truth.x(), mark.truth.y(), error.x(), error.y(), major.norm(), axes.col(0).norm(),
                 180 / std::numbers::pi * std::atan2(major.y(), major.x()));
}

/// The landmarks, then the robot with its heading in a second block.
std::string marks_of(const Belief& belief, std::size_t number) {
  std::string text = fmt::format("$marks{} << EOD\n", number);
  for (std::size_t i = 0; i < belief.landmarks.size(); ++i) {
    const PointPair& landmark = belief.landmarks[i];
    const auto row = static_cast<Eigen::Index>(3 + 2 * i);
    append_mark({landmark.true_point, landmark.est_point - landmark.true_point,
                 belief.covariance.block<2, 2>(row, row)},
                text);
  }
  text += fmt::format("EOD\n$robot{} << EOD\n", number);
  const seif::Pose2& truth = belief.pose.true_pose;
  append_mark({{truth.x, truth.y},
               pose_error(belief.pose.est_pose, truth).head<2>(),
               belief.covariance.topLeftCorner<2, 2>()},
              text);
  return text + fmt::format("EOD\n$heading{} << EOD\n{:.4f} {:.4f} {:.4f} {:.4f}\nEOD\n", number, truth.x,
                            truth.y, std::cos(truth.theta), std::sin(truth.theta));
}

/// One line for each link: start, difference, colour.
std::string network_of(const Belief& belief, std::size_t number) {
  const auto place = [&](int landmark) -> Eigen::Vector2d {
    if (landmark == robot) return {belief.pose.est_pose.x, belief.pose.est_pose.y};
    return belief.landmarks[static_cast<std::size_t>(landmark)].est_point;
  };
  std::string between = fmt::format("$links{} << EOD\n", number);
  std::string of_robot = fmt::format("$robot_links{} << EOD\n", number);
  std::string landmarks = fmt::format("$landmarks{} << EOD\n", number);
  for (std::size_t i = 0; i < belief.landmarks.size(); ++i) {
    const Eigen::Vector2d p = place(static_cast<int>(i));
    fmt::format_to(std::back_inserter(landmarks), "{:.4f} {:.4f}\n", p.x(), p.y());
  }
  for (const NetworkLink& link : links_of(normalised(belief.information))) {
    const Eigen::Vector2d from = place(link.from);
    const Eigen::Vector2d along = place(link.to) - from;
    const Rgb colour = link.from == robot ? palette::vermilion : palette::green;
    fmt::format_to(std::back_inserter(link.from == robot ? of_robot : between),
                   "{:.4f} {:.4f} {:.4f} {:.4f} {}\n", from.x(), from.y(), along.x(), along.y(),
                   faded(colour, faintest + (1 - faintest) * std::sqrt(link.strength)));
  }
  return between + "EOD\n" + of_robot + "EOD\n" + landmarks + "EOD\n";
}

std::string matrix_of(const Eigen::MatrixXd& M, std::string_view name, std::size_t number) {
  std::string text = fmt::format("${}{} << EOD\n", name, number);
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < M.cols(); ++j) fmt::format_to(std::back_inserter(text), "{:.3f} ", M(i, j));
    text += '\n';
  }
  return text + "EOD\n";
}

std::string data_of(const Belief& belief, std::size_t number) {
  return marks_of(belief, number) + network_of(belief, number) +
         matrix_of(normalised(belief.covariance), "correlation", number) +
         matrix_of(normalised(belief.information).cwiseSqrt(), "information", number);
}

std::string title_of(const Belief& belief, std::string_view what) {
  const PaperRow* row = paper_row(belief.estimator);
  const std::string name = row == nullptr ? belief.estimator : std::string(row->title);
  return gnuplot_text(fmt::format("{}: {}", name, what));
}

/// The axes of a square that holds the whole map, the same for all filters.
std::string map_axes(const Belief& belief) {
  double reach = 0.0;
  for (const PointPair& landmark : belief.landmarks)
    reach = std::max(reach, landmark.true_point.cwiseAbs().maxCoeff());
  return fmt::format(
      "set size ratio 1\nset xrange [{0}:{1}]\nset yrange [{0}:{1}]\nset grid lc '#eeeeee' lt 1\n",
      -reach - margin, reach + margin);
}

std::string map_panel(const Belief& belief, std::size_t number) {
  const std::string title = title_of(belief, fmt::format("map; errors, 2 sigma x {}", enlargement));
  return fmt::format(
      "{0}set title {1} noenhanced font ',10'\nplot $marks{2} with vectors nohead lw 1 lc rgb {3}, "
      "$marks{2} using ($1+$3):($2+$4):5:6:7 with ellipses units xy fs lc rgb {3} lw 1, "
      "$robot{2} using ($1+$3):($2+$4):5:6:7 with ellipses units xy lc rgb 'black' lw 1.5, "
      "$marks{2} with points pt 7 ps 0.35 lc rgb 'black', "
      "$heading{2} with vectors filled head size 0.5,25 lw 2 lc rgb 'black'\n",
      map_axes(belief), title, number, gnuplot_colour(colour_of_estimator(belief.estimator)));
}

std::string links_panel(const Belief& belief, std::size_t number) {
  return fmt::format(
      "{}set title {} noenhanced font ',10'\nplot $links{} with vectors nohead lw 1 lc rgb variable, "
      "$robot_links{} with vectors nohead lw 2 lc rgb variable, "
      "$landmarks{} with points pt 7 ps 0.5 lc rgb '#555555', "
      "$heading{} with vectors filled head size 0.5,25 lw 2 lc rgb 'black'\n",
      map_axes(belief), title_of(belief, "links"), number, number, number, number);
}

std::string matrix_panel(const Belief& belief, std::string_view name, std::string_view what,
                         std::size_t number) {
  const auto last = static_cast<double>(belief.covariance.rows()) - 0.5;
  return fmt::format(
      "set size ratio 1\nunset grid\nset xrange [-0.5:{0}]\nset yrange [{0}:-0.5]\n"
      "set title {1} noenhanced font ',10'\nplot ${2}{3} matrix with image\n",
      last, gnuplot_text(std::string(what)), name, number);
}

std::string correlation_panel(const Belief& belief, std::size_t number) {
  return matrix_panel(belief, "correlation", "correlation", number);
}

std::string information_panel(const Belief& belief, std::size_t number) {
  return matrix_panel(belief, "information", "normalised information", number);
}

std::string multiplot(std::size_t rows, int columns, const std::string& panels) {
  return fmt::format("set multiplot layout {},{}\n{}unset multiplot\n", rows, columns, panels);
}

}  // namespace

Picture figure_1(const Belief& ekf) {
  const std::string panels = map_panel(ekf, 0) + correlation_panel(ekf, 0) + information_panel(ekf, 0);
  return {"figure1", 3 * panel, panel, settings + data_of(ekf, 0), multiplot(1, 3, panels)};
}

Picture figure_2(const Belief& seif) {
  const std::string panels = information_panel(seif, 0) + links_panel(seif, 0);
  return {"figure2", 2 * panel, panel, settings + data_of(seif, 0), multiplot(1, 2, panels)};
}

Picture figure_6(std::span<const Belief> beliefs) {
  std::string data = settings;
  std::string panels;
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    data += data_of(beliefs[i], i);
    panels += map_panel(beliefs[i], i) + links_panel(beliefs[i], i) + correlation_panel(beliefs[i], i) +
              information_panel(beliefs[i], i);
  }
  return {"figure6", 4 * panel, static_cast<int>(beliefs.size()) * panel, data,
          multiplot(beliefs.size(), 4, panels)};
}

}  // namespace harness
