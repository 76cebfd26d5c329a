# How a frame's time grows with one thing at a time.
# gnuplot -e "csv='scaling.csv'; one='scaling_1_thread.csv'; png='scaling.png'" scaling.gp
set datafile separator comma
set terminal pngcairo size 1400,1000 font "DejaVu Sans,11"
set output png
set datafile missing NaN  # lines go on past the rows of others

point(name, plan) = strcol("sweep") eq name && strcol("plan") eq plan
x_of(name, plan) = point(name, plan) ? column("value") : NaN
sums = "#0072b2"
ordered = "#d55e00"

set logscale xy
set grid xtics ytics lt 1 lc rgb "#dddddd"
set format y "10^{%L}"
set key top left reverse Left
set multiplot layout 2,2 margins 0.07,0.98,0.075,0.955 spacing 0.09,0.12

set title "particles of a clustered universe, 1400 x 1050 pixels"
set xlabel "particles"
set format x "10^{%L}"
set ylabel "ms per frame (median)"
plot csv using (x_of("particles", "proportional")):"median_ms" with linespoints pt 7 lw 2 lc rgb sums title "sums, all threads", \
     one using (x_of("particles", "proportional")):"median_ms" with linespoints pt 6 dt 2 lw 2 lc rgb sums title "sums, one thread", \
     csv using (x_of("particles", "ordered")):"median_ms" with linespoints pt 7 lw 2 lc rgb ordered title "ordered, all threads", \
     one using (x_of("particles", "ordered")):"median_ms" with linespoints pt 6 dt 2 lw 2 lc rgb ordered title "ordered, one thread"

set format x "%g"
set title "pixels"
set xlabel "million pixels"
plot csv using (x_of("megapixels", "proportional")):"median_ms" with linespoints pt 7 lw 2 lc rgb sums title "sums", \
     csv using (x_of("megapixels", "ordered")):"median_ms" with linespoints pt 7 lw 2 lc rgb ordered title "ordered"

set title "field of view"
set xlabel "degrees"
set xrange [80:0.8]
set xtics (60, 30, 15, 8, 4, 2, 1)
plot csv using (x_of("field_of_view", "proportional")):"median_ms" with linespoints pt 7 lw 2 lc rgb sums title "sums", \
     csv using (x_of("field_of_view", "ordered")):"median_ms" with linespoints pt 7 lw 2 lc rgb ordered title "ordered"
set xrange [*:*]
set xtics auto

set title "size of the splats"
set xlabel "mean sigma in pixels"
set ylabel "ns per particle (median)"
plot csv using (x_of("sigma", "proportional")):"ns_per_particle" with linespoints pt 7 lw 2 lc rgb sums title "sums", \
     csv using (x_of("sigma", "ordered")):"ns_per_particle" with linespoints pt 7 lw 2 lc rgb ordered title "ordered"
unset multiplot
