// A dramatic sky: heavy clouds lit from a low sun, over a dark horizon with trees.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "functions.inc"

camera { location <0, 2, 0> look_at <0, 5.3, 12> angle 66 right x*3/2 }
// Cloud cover as a function of the direction: fractal noise on a plane overhead,
// with the light side found by a second, shifted look-up.
#declare Cover = function(x, y, z) { f_noise3d(x*0.6, y*0.6, z+11)*0.30 + f_noise3d(x, y, z)*0.36 + f_noise3d(x*2.1, y*2.1, z*2.1+3)*0.24
  + f_noise3d(x*4.3, y*4.3, z*4.3+7)*0.13 + f_noise3d(x*8.9, y*8.9, z*8.9)*0.075 + f_noise3d(x*18, y*18, z*18)*0.04 + f_noise3d(x*37, y*37, z*37)*0.02 }
#declare U = function(x, y) { x*1.05/(y+0.30) }
#declare W = function(y) { 1.5/(y+0.30) }
#declare Thick = function(x, y) { max(0, Cover(U(x,y)*1.15 + 4.1, W(y)*1.35 + 0.4, 5.6) - 0.50)*5.5 }
#declare Mask = function(x, y) { 1 - exp(-3.2*Thick(x, y)) }
#declare Lit = function(x, y) { Thick(x, y) - Thick(x + 0.05*(-0.20 - x), y + 0.05*(0.12-y) - 0.008) }
#declare Glow = function(x, y) { exp(-((x+0.20)*(x+0.20)*3.4 + (y-0.14)*(y-0.14)*8)) }
#declare Tone = function(x, y) {
  min(0.999, max(0, (0.34 + 0.66*Glow(x,y) + 0.10*max(0, 0.3-y))*(1 - Mask(x,y))
   + Mask(x,y)*(0.13 + 0.62*Glow(x,y)*exp(-Thick(x,y)*1.5) + 1.1*(0.5+0.8*Glow(x,y))*max(-0.10, Lit(x,y))) )) }
plane { -z, -1000 pigment { function { Tone((x)/900, (y)/900) }
    color_map { [0 rgb <.010,.014,.022>] [0.15 rgb <.075,.092,.125>] [0.4 rgb <.30,.32,.35>] [0.7 rgb <.74,.70,.62>] [1 rgb <1.0,.97,.90>] } }
  finish { ambient 0 emission 1 diffuse 0 } }

// Dark land.
isosurface { function { y - 20*f_noise3d(x*0.011, 2, 0) - 2.0*f_noise3d(x*0.12, 5, 0) - 1.6*f_noise3d(x*0.6, y*0.6, 4) + 3 }
  contained_by { box { <-400, -20, 198>, <400, 24, 202> } } max_gradient 1.6 pigment { rgb <.010,.010,.012> } finish { ambient 0 emission 1 diffuse 0 } }
plane { y, -2 pigment { rgb <.010,.010,.012> } finish { ambient 0 emission 1 diffuse 0 } }
// Two bare trees against the light.
#declare S = seed(21);
#macro Branch(P, D, L, R, Depth)
  #local Q = P + D*L;
  cone { P, R, Q, R*0.7 } sphere { Q, R*0.7 }
  #if (Depth > 0)
    #for (K, 1, 3)
      Branch(Q, vnormalize(D + 0.8*<rand(S)*2-1, rand(S)*1.1-0.4, rand(S)*0.6-0.3>), L*(0.62+0.22*rand(S)), R*0.6, Depth-1)
    #end
  #end
#end
union { Branch(<0,-2,0>, <0.08,1,0>, 5.0, 0.62, 6) translate <22, 0, 72> pigment { rgb 0.008 } finish { ambient 0 emission 1 diffuse 0 } }
union { Branch(<0,-2,0>, <-0.1,1,0>, 3.2, 0.42, 5) translate <29.5, 0, 76> pigment { rgb 0.008 } finish { ambient 0 emission 1 diffuse 0 } }
