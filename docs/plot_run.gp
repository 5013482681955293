# Draws a run folder: the way that was driven and the maps that came of it, with their 2-sigma ellipses.
#   gnuplot -e "run='runs/courtyard-1'; out='courtyard.png'" docs/plot_run.gp
# Colours: Okabe and Ito's palette, which the colour-blind can tell apart.
set terminal pngcairo size 1800,640 font "DejaVu Sans,11" background "white"
set output out
set datafile separator ","
set size ratio -1
set key above left maxrows 2 samplen 2 textcolor "#333333"
set border lc "#888888"
set tics textcolor "#333333"
set xlabel "x [m]"
set ylabel "y [m]"
set grid lc "#e6e6e6" lt 1

# A covariance as an ellipse of two standard deviations: full axes and the angle of the first.
half_sum(a, c) = (a + c) / 2
half_gap(a, b, c) = sqrt(((a - c) / 2)**2 + b**2)
major(a, b, c) = 4 * sqrt(half_sum(a, c) + half_gap(a, b, c))
minor(a, b, c) = 4 * sqrt(abs(half_sum(a, c) - half_gap(a, b, c)))
angle(a, b, c) = 90 / pi * atan2(2 * b, a - c)

tum(name) = sprintf("< awk '/^[^#]/ {print $2 \",\" $3}' %s/%s.tum", run, name)
map(name) = sprintf("%s/%s_map.csv", run, name)
landmarks = run . "/landmarks.csv"

set multiplot layout 1,3
do for [estimator in "ekf seif seif_report"] {
  colour = estimator eq "ekf" ? "#0072B2" : estimator eq "seif" ? "#009E73" : "#D55E00"
  set title estimator noenhanced font ",14" offset 0,-0.3
  plot tum("odometry") with lines lw 1 lc "#AAAAAA" title "odometry", \
       tum("truth") with lines lw 2 lc "#000000" title "truth", \
       tum(estimator) with lines lw 1.5 lc rgb colour title "estimate" noenhanced, \
       landmarks using 2:3 every ::1 with points pt 6 ps 1.1 lc "#000000" title "landmark", \
       map(estimator) using 2:3:(major($4, $5, $6)):(minor($4, $5, $6)):(angle($4, $5, $6)) every ::1 \
         with ellipses units xy lc rgb colour lw 1.5 title "estimate, 2 sigma", \
       map(estimator) using 2:3 every ::1 with points pt 2 ps 0.7 lc rgb colour notitle
}
unset multiplot
