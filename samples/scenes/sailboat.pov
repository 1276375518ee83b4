// A sailboat on quiet water at evening: clouds, far shore, reflections.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }
#include "functions.inc"

camera { location <0, 2.6, -15> look_at <0.3, 2.75, 0> angle 46 right x*4/3 }
light_source { <-70, 50, -38>*10 rgb <1.0, 0.90, 0.74>*1.5 }
light_source { <30, 40, -60>*10 rgb <0.65, 0.75, 0.95>*0.35 shadowless }
#default { finish { ambient 0.08 diffuse 0.8 } }

// Sky: a clear gradient and a layer of cloud over it.
sky_sphere {
  pigment { gradient y color_map {
    [0.00 rgb <.98,.90,.74>] [0.06 rgb <.86,.83,.76>] [0.22 rgb <.46,.56,.66>] [0.6 rgb <.16,.25,.40>] [1 rgb <.10,.17,.30>] } }
  pigment { wrinkles turbulence 0.45 octaves 6 omega 0.55 scale <0.75, 0.16, 0.75> translate <0.35, 0.04, 0.1>
    color_map { [0.00 rgbt <1,.97,.90,0.0>] [0.28 rgbt <.97,.93,.86,0.05>] [0.45 rgbt <.60,.61,.66,0.30>] [0.62 rgbt <.5,.5,.55,1>] [1 rgbt 1] } }
}

// Water: ripples get smaller with distance.
plane { y, 0
  pigment { rgb <.025,.050,.065> }
  normal { average normal_map {
    [1.0 bumps 0.075 scale <1.6, 1, 0.40>] [0.8 bumps 0.085 scale <0.6, 1, 0.16> rotate 12*y] [0.6 bumps 0.07 scale <5, 1, 1.2> rotate -8*y] } }
  finish { diffuse 0.5 ambient 0.02 specular 0.5 roughness 0.006 reflection { 0.08, 0.95 fresnel on } conserve_energy }
  interior { ior 1.33 } }

// Far shore: two wooded ridges and a spit with trees.
#macro Ridge(Z, H, Colour, Freq, Seed)
  isosurface { function { y - H*(0.35 + 1.1*f_noise3d(x*Freq, Seed, 0)*(0.5+0.5*sin(x*0.013+Seed))) - H*0.10*f_noise3d(x*Freq*9, Seed, z*Freq*9) - 0.05*H*f_noise3d(x*Freq*30, y*Freq*30, z*Freq*9) + abs(z-Z)*0.12 }
    contained_by { box { <-320, -1, Z-20>, <320, H*1.8, Z+20> } } max_gradient 3.2 accuracy 0.02
    pigment { rgb Colour } finish { ambient 0.25 diffuse 0.6 } }
#end
Ridge(300, 20, <.34,.40,.48>, 0.010, 4)
Ridge(190, 8, <.13,.17,.19>, 0.022, 9.3)
#declare S = seed(5);
#for (I, 0, 60)  // trees on the spit, right
  #local X = 26 + 60*pow(rand(S), 1.3); #local R = 1.4 + 2.2*rand(S);
  #local Z = 108 + 5*rand(S); #local C = <.030,.045,.030>*(0.7+0.8*rand(S)); #local H = 0.9 + 0.9*rand(S);
  union {
    #for (K, 1, 70)
      #local D = <rand(S)*2-1, rand(S)*2-0.9, rand(S)*2-1>;
      sphere { D*<0.75, H, 0.7>*R*sqrt(rand(S)), R*(0.08+0.17*rand(S)) }
    #end
    translate <X, 0.9+R*0.7*H, Z> pigment { rgb C } normal { bumps 1.0 scale 0.3 } }
#end
sphere { 0, 1 scale <46, 1.4, 8> translate <62, 0, 108> pigment { rgb <.10,.09,.06> } }

// The boat. x: ahead is to the right; the sails are thin bent sheets.
#declare Wood = texture { pigment { rgb <.24,.11,.05> } finish { specular 0.4 roughness 0.02 } }
#declare Hull = isosurface {
  function { max(abs(z) - 1.02*sqrt(max(0, 1 - pow(abs((x+0.15-0.35*y*select(x, 0.3, 1))/3.2), 2.4)))*pow(max(0, (y+0.75)/1.75), 0.55), max(y - (0.62 + 0.035*x*x*0.9 + 0.04*x), -0.75 - y)) }
  contained_by { box { <-3.5,-0.75,-1.2>, <3.5,1.3,1.2> } } max_gradient 6 accuracy 0.003 }
#macro Sail(A, B, C, Belly)  // triangle A B C with a belly towards -z
  #local N = 26;
  #macro P(U, W) (A*(1-U-W) + B*U + C*W - z*Belly*sin(pi*min(1, U/max(1-W, 0.001)))*(1-W)*(0.4+1.2*W)) #end
  #macro Nrm(U, W) vnormalize(vcross(P(U+0.01, W) - P(U-0.01, W), P(U, W+0.01) - P(U, W-0.01))) #end
  #macro Tri(I1, J1, I2, J2, I3, J3) smooth_triangle { P(I1/N,J1/N), Nrm(I1/N,J1/N), P(I2/N,J2/N), Nrm(I2/N,J2/N), P(I3/N,J3/N), Nrm(I3/N,J3/N) } #end
  mesh {
    #for (I, 0, N-1) #for (J, 0, N-1-I)
      Tri(I, J, I+1, J, I, J+1)
      #if (I+J < N-1) Tri(I+1, J, I+1, J+1, I, J+1) #end
    #end #end
    texture { pigment { gradient y scale 0.62 color_map { [0 rgb <.97,.95,.90>] [0.955 rgb <.97,.95,.90>] [0.96 rgb <.60,.57,.52>] [1 rgb <.60,.57,.52>] } }
      finish { ambient 0.22 diffuse 0.9 } } }
#end
union {
  object { Hull pigment { gradient y scale 2 translate -0.75*y color_map {
      [0.0 rgb <.30,.05,.04>] [0.43 rgb <.30,.05,.04>] [0.431 rgb .85] [0.48 rgb .85] [0.481 rgb <.035,.045,.075>] [1 rgb <.035,.045,.075>] } }
    finish { specular 0.5 roughness 0.02 reflection 0.04 } }
  // Cabin, rail, mast, boom, stays.
  superellipsoid { <0.3, 0.3> scale <0.85, 0.34, 0.52> translate <0.45, 0.85, 0> pigment { rgb <.80,.74,.62> } }
  #for (I, 0, 2) cylinder { <0.0+I*0.42, 0.93, -0.56>, <0.0+I*0.42, 0.93, -0.4>, 0.10 pigment { rgb 0.02 } } #end
  cylinder { <0.9,0.6,0>, <0.82,8.3,0>, 0.065 texture { Wood } }
  cylinder { <0.9,1.45,0>, <-2.75,1.50,-0.35>, 0.05 texture { Wood } }
  cylinder { <3.2,1.05,0>, <4.1,1.25,0>, 0.045 texture { Wood } }
  union { cylinder { <4.05,1.25,0>, <0.82,8.2,0>, 0.016 } cylinder { <-3.2,1.0,0>, <0.82,8.2,0>, 0.016 }
    cylinder { <0.7,0.7,-0.95>, <0.82,6.4,0>, 0.014 } pigment { rgb 0.05 } }
  object { Sail(<0.78,1.62,0>, <-2.65,1.65,-0.35>, <0.78,8.0,0>, 0.55) }
  object { Sail(<1.05,1.30,-0.25>, <3.95,1.42,0>, <0.90,7.3,0>, 0.45) }
  // A helmsman.
  union { sphere { <-1.75,1.62,-0.60>, 0.19 pigment { rgb <.55,.36,.26> } }
    sphere_sweep { b_spline 5, <-1.75,.4,-.6>,.3, <-1.78,.7,-.6>,.3, <-1.75,1.05,-.6>,.27, <-1.74,1.3,-.6>,.16, <-1.74,1.5,-.6>,.1 pigment { rgb <.45,.06,.05> } }
    sphere_sweep { linear_spline 3, <-1.75,1.25,-.72>,.1, <-2.05,1.0,-.85>,.085, <-2.5,1.05,-.5>,.07 pigment { rgb <.45,.06,.05> } }
    sphere { <-1.75,1.68,-0.60>, 0.205 pigment { rgb 0.9 } clipped_by { plane { -y, -1.70 } } } }
  triangle { <0.82,8.3,0>, <0.82,8.65,0>, <0.05,8.42,0.1> pigment { rgb <.55,.05,.04> } }
  rotate <-4, -14, 2> scale 0.68 translate <-0.6, 0.02, 0.0> }
// Gulls.
#macro Gull(C, R) union { sphere_sweep { b_spline 5, <-1.4,.0,0>,.03, <-1,.2,0>,.05, <-.45,.38,0>,.07, <0,0,0>,.12, <.1,-.1,0>,.1 } sphere_sweep { b_spline 5, <1.4,.1,0>,.03, <1,.3,0>,.05, <.45,.4,0>,.07, <0,0,0>,.12, <-.1,-.1,0>,.1 } pigment { rgb 0.05 } scale R translate C } #end
Gull(<5.5, 7.2, 4>, 0.35) Gull(<6.8, 7.9, 6>, 0.3) Gull(<4.6, 8.2, 8>, 0.25)
