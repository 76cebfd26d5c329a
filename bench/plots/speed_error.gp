# Milliseconds against the measured error, and the error against its promise.
# gnuplot -e "csv='speed_error.csv'; png='speed_error.png'" speed_error.gp
set datafile separator comma
set terminal pngcairo size 1500,1050 font "DejaVu Sans,11"
set output png

scenes = "'sparse stars|small' 'sparse stars|large' 'thin gas|small' 'thin gas|large' \
'thick gas|small' 'thick gas|large' 'gas and stars|small' 'gas and stars|large' 'universe|all'"
colours = "#c9a400 #8a7000 #56b4e9 #0072b2 #e69f00 #d55e00 #66cc99 #009e73 #000000"
plans = "emission proportional ordered"
# A frame that meets every bit of the reference would have no place on a logarithmic scale.
smallest = 1e-10
is_point(plan, scene) = strcol("plan") eq plan && strcol("scene")."|".strcol("splats") eq scene
error_of(plan, scene) = is_point(plan, scene) ? (column("max_error") > smallest ? column("max_error") : smallest) : NaN
title_of(scene) = scene[:strstrt(scene, "|") - 1].", ".scene[strstrt(scene, "|") + 1:]
# Tolerance 0 stands at what it promises.
promise_of(plan, scene) = is_point(plan, scene) ? column("promise") : NaN

set logscale xy
set grid xtics ytics lt 1 lc rgb "#dddddd"
set format x "10^{%L}"
set xrange [5e-9:5e-2]
set pointsize 1.1

set multiplot layout 2,3 margins 0.06,0.985,0.135,0.955 spacing 0.055,0.11
set key off
do for [p = 1:3] {
  plan = word(plans, p)
  set title plan
  set xlabel "measured largest error"
  set ylabel p == 1 ? "ms per frame; rings: the reference" : ""
  set yrange [0.5:3e5]
  set format y "%g"
  plot for [s = 1:9] csv using (error_of(plan, word(scenes, s))):"median_ms" \
         with linespoints pt 7 ps 0.9 lw 1.5 lc rgb word(colours, s), \
       for [s = 1:9] csv using (is_point(plan, word(scenes, s)) ? 7e-9 : NaN):"reference_ms" \
         with points pt 6 ps 1.3 lc rgb word(colours, s)
}
set format y "10^{%L}"
set yrange [5e-9:5e-2]
do for [p = 1:3] {
  plan = word(plans, p)
  set title plan
  set xlabel "promised error (tolerance; 1e-6 stands for 0)"
  set ylabel p == 1 ? "measured largest error" : ""
  set xrange [5e-7:2e-2]
  plot x with lines lw 2 dt 2 lc rgb "#888888", \
       for [s = 1:9] csv using (promise_of(plan, word(scenes, s))):(error_of(plan, word(scenes, s))) \
         with points pt 7 ps 1.1 lc rgb word(colours, s)
}

# The key, under all six.
set lmargin at screen 0.05
set rmargin at screen 0.99
set tmargin at screen 0.07
set bmargin at screen 0.0
unset title
unset xlabel
unset ylabel
unset border
unset tics
unset grid
set key inside center center horizontal samplen 1.5 maxcols 5
plot NaN with lines lw 2 dt 2 lc rgb "#888888" title "the promise", \
     for [s = 1:9] NaN with points pt 7 ps 1.1 lc rgb word(colours, s) title title_of(word(scenes, s))
unset multiplot
