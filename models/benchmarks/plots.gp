# One page: three quantities of two coordinates, ours as lines, the reference as circles.
# gnuplot -e "ours='results.csv'; reference='reference.csv'; picture='x.svg'; first='beta'; second='gamma'; heading='...'" plots.gp
set datafile separator ","
set terminal svg size 900,1000 font "DejaVu Sans,13" background "white"
set output picture
set multiplot layout 3,1 title heading
set key outside right top
set grid
set xlabel "time (s)"
do for [quantity in "position velocity acceleration"] {
  ending = quantity eq "position" ? "" : quantity eq "velocity" ? "_rate" : "_acceleration"
  unit = quantity eq "position" ? "rad" : quantity eq "velocity" ? "rad/s" : "rad/s^2"
  a = first.ending." [".unit."]"
  b = second.ending." [".unit."]"
  set ylabel quantity." (".unit.")" noenhanced
  plot ours using "time [s]":a with lines lw 2 lc rgb "#1f5fa8" title first, \
       ours using "time [s]":b with lines lw 2 lc rgb "#c8501e" title second, \
       reference using "time [s]":a with points pt 6 ps 0.6 lc rgb "#1f5fa8" title first.", reference", \
       reference using "time [s]":b with points pt 6 ps 0.6 lc rgb "#c8501e" title second.", reference"
}
unset multiplot
