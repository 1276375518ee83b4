// Still life: jug, bowl with fruit, vase, and a cloth on a table; strong light from the left.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "functions.inc"

camera { location <0.6, 3.3, -12.5> look_at <0.55, 1.95, 0> angle 41 right x*4/3 }
light_source { <-11, 8.5, -6> rgb <1.0, 0.94, 0.84>*1.75
  area_light <1.2,0,1.2>, <0,1.4,0>, 9, 9 adaptive 2 }
light_source { <9, 5, -12> rgb <0.6, 0.7, 0.9>*0.10 shadowless }
#default { finish { ambient rgb 0.035 diffuse 0.8 } }

// A turned pot: outside from points (radius, height), open at the top.
#macro Glaze(Dark, Light, Turb)
  texture { pigment { bozo turbulence Turb scale <0.9,0.5,0.9>
      color_map { [0.2 rgb Dark] [0.8 rgb Light] } }
    normal { gradient y 0.04 scale 0.09 turbulence 0.1 }
    finish { specular 0.55 roughness 0.02 diffuse 0.75 reflection { 0.01, 0.10 fresnel on } conserve_energy } }
  interior { ior 1.5 }
#end

// Wall and table.
plane { z, 15 pigment { bozo scale 3 turbulence 0.5 color_map { [0 rgb <.32,.31,.29>] [1 rgb <.40,.39,.36>] } } }
box { <-9, -1.6, -2.6>, <9, 0, 4>
  pigment { wood rotate <3, 88, 0> scale <1, 0.3, 0.35> turbulence 0.06
    color_map { [0 rgb <.20,.115,.06>] [0.6 rgb <.30,.18,.10>] [1 rgb <.15,.085,.045>] } }
  normal { bumps 0.05 scale <0.6, 0.02, 0.03> } finish { specular 0.12 roughness 0.05 } }

// Jug with a handle.
union {
  sor { 9, <1.0,-0.2>, <1.0,0>, <1.42,0.8>, <1.38,1.6>, <0.88,2.5>, <0.66,3.1>, <0.80,3.6>, <0.92,3.85>, <0.95,4.0> open sturm }
  torus { 0.90, 0.06 translate 3.82*y }
  sphere_sweep { b_spline 7, <0.5,3.6,0>, 0.14, <0.72,3.4,0>, 0.14, <1.45,3.45,0>, 0.13, <1.78,2.6,0>, 0.13,
    <1.52,1.75,0>, 0.13, <1.15,1.5,0>, 0.15, <0.9,1.4,0>, 0.15 rotate 18*y }
  Glaze(<.36,.13,.06>, <.62,.27,.13>, 0.6)
  translate <-1.65, 0, 0.9> }

// Tall pale vase with a dark band and three dry twigs.
union {
  sor { 9, <0.5,-0.2>, <0.55,0>, <0.92,0.7>, <0.98,1.3>, <0.62,2.2>, <0.28,2.8>, <0.30,3.1>, <0.42,3.28>, <0.45,3.4> open sturm
    texture { pigment { gradient y scale 3.4 color_map {
        [0 rgb <.80,.78,.72>] [0.30 rgb <.86,.84,.78>] [0.305 rgb <.10,.13,.20>] [0.345 rgb <.10,.13,.20>]
        [0.35 rgb <.86,.84,.78>] [0.40 rgb <.86,.84,.78>] [0.405 rgb <.10,.13,.20>] [0.42 rgb <.10,.13,.20>] [0.425 rgb <.86,.84,.78>] [1 rgb <.84,.82,.76>] } }
      finish { specular 0.7 roughness 0.01 } } }
  #macro Twig(P1, P2, P3) sphere_sweep { cubic_spline 6, <0,1,0>, .05, <0,2.6,0>, .05, P1, .042, P2, .030, P3, .016, 2*P3-P2, .01
      pigment { rgb <.13,.08,.05> } } #end
  Twig(<-.1,3.7,0>, <-.45,4.7,.1>, <-.55,5.4,.1>)
  Twig(<.15,3.7,0>, <.50,4.4,-.1>, <1.0,5.2,-.1>)
  Twig(<.05,3.7,.1>, <.1,4.3,.2>, <.28,4.9,.2>)
  #local S = seed(11);
  #for (I, 1, 22)  // leaves and buds along the twigs
    #local T = rand(S); #local B = mod(I, 2);
    #local P = (B = 0 ? <-.1,3.7,0>+T*<-.42,1.5,.1> : <.15,3.75,0>+T*<.78,1.3,-.1>);
    sphere { 0, 0.16 scale <1.0, 0.42, 0.22> translate 0.14*x rotate <40*rand(S), 60*rand(S)-30, 200*rand(S)-10> translate P
      pigment { rgb <.20,.26,.12>*(0.6+0.8*rand(S)) } }
  #end
  translate <3.0, 0, 1.1> }

// Bowl with fruit.
union {
  sor { 7, <0.55,-0.2>, <0.62,0>, <0.95,0.18>, <1.32,0.55>, <1.52,0.98>, <1.58,1.12>, <1.6,1.3> open sturm }
  torus { 1.555, 0.045 translate 1.06*y }
  Glaze(<.05,.10,.14>, <.16,.26,.30>, 0.4)
  translate <0.75, 0, -0.7> }
#macro Apple(C, R, Rot, Warm)
  union {
    isosurface { function { sqrt(x*x+y*y*1.08+z*z) - 0.93 + 0.42*exp(-(x*x+z*z)*9)*select(y, 0.4, 1) - 0.05*y }
      contained_by { sphere { 0, 1.2 } } max_gradient 4 accuracy 0.002
      pigment { function { min(0.99, max(0.01, (0.5 + 0.10*sin(7*atan2(z,x) + 3*f_noise3d(x*2,y*2,z*2)) + 0.55*x + 0.25*(f_noise3d(x*9,y*2,z*9)-0.5)))) }
        color_map { [0 rgb <.80,.60,.20>*Warm] [0.45 rgb <.68,.20,.09>*Warm] [1 rgb <.44,.06,.05>*Warm] } }
      finish { specular 0.6 roughness 0.015 } }
    sphere_sweep { linear_spline 3, <0,.45,0>, .045, <.05,.85,0>, .04, <.18,1.12,0>, .055 pigment { rgb <.12,.07,.04> } }
    scale R rotate Rot translate C }
#end
Apple(<0.15, 1.12, -1.05>, 0.60, <-12, 30, 14>, 1.0)
Apple(<1.35, 1.15, -0.95>, 0.58, <-20, 160, -16>, 0.9)
Apple(<0.80, 1.30, -0.15>, 0.60, <10, 80, 5>, 1.1)
// A lemon and a plum on the table, a pear in front.
sphere { 0, 0.52 scale <1.32, 1, 1> pigment { rgb <.86,.66,.12> } normal { bumps 0.22 scale 0.06 } finish { specular 0.35 roughness 0.04 }
  rotate 25*y translate <2.75, 0.52, -1.35> }
sphere { 0, 0.40 pigment { rgb <.10,.04,.12> } finish { specular 0.5 roughness 0.04 } translate <3.75, 0.40, -0.9> }
sor { 8, <0.02,-0.05>, <0.30,0.0>, <0.66,0.35>, <0.68,0.70>, <0.42,1.15>, <0.31,1.45>, <0.16,1.66>, <0.01,1.70>
  pigment { bozo scale 0.5 turbulence 0.4 color_map { [0.2 rgb <.55,.52,.16>] [0.8 rgb <.68,.50,.18>] } }
  finish { specular 0.4 roughness 0.03 } rotate -8*z translate <-0.95, 0.10, -1.45> }
sphere_sweep { b_spline 5, <0,1.5,0>, .05, <0,1.65,0>, .045, <.03,1.8,0>, .04, <.14,2.0,0>, .055, <.2,2.1,0>, .05
  pigment { rgb <.12,.07,.04> } rotate -8*z translate <-0.95, 0.10, -1.45> }

// White cloth: a mesh that lies on the table and hangs over its front edge in folds.
// U runs along the edge (x), T from the back of the cloth (0) over the edge (1) down (2).
#declare Wave = function(x, z) { f_noise3d(x*1.1, 3, z*1.1) }
#declare Fold = function(x) { 0.5 + 0.5*sin(x*4.1 + 2.6*f_noise3d(x*0.8, 1, 5)) }
#macro Cloth(U, T)
  #local X = -3.4 + 4.0*U + 0.10*sin(T*5 + U);
  #if (T < 1)
    #local Z = -0.2 - 2.42*T + 0.25*sin(U*7)*(1-T);
    #local P = <X - 0.35*(1-T), 0.03 + (0.12*Wave(X, Z) + 0.17*pow(Fold(X + 0.5*Z), 3))*min(1, (1-T)*3 + 0.15), Z>;
  #else
    #local H = T - 1;
    #local P = <X + 0.05*sin(H*4+U*9), 0.045 - 2.1*H - 0.10*U*H, -2.64 - (0.05 + 0.42*Fold(X + 0.15*H))*sin(min(1, H*1.8)*pi/2)>;
  #end
  P
#end
#declare NU = 90; #declare NT = 80;
#declare Grid = array[NU+1][NT+1];
#for (I, 0, NU) #for (J, 0, NT) #declare Grid[I][J] = Cloth(I/NU, 2*J/NT); #end #end
#macro Normal(I, J) vnormalize(vcross(Grid[I][min(J+1,NT)] - Grid[I][max(J-1,0)], Grid[min(I+1,NU)][J] - Grid[max(I-1,0)][J])) #end
mesh {
  #for (I, 0, NU-1) #for (J, 0, NT-1)
    smooth_triangle { Grid[I][J], Normal(I,J), Grid[I+1][J], Normal(I+1,J), Grid[I+1][J+1], Normal(I+1,J+1) }
    smooth_triangle { Grid[I][J], Normal(I,J), Grid[I+1][J+1], Normal(I+1,J+1), Grid[I][J+1], Normal(I,J+1) }
  #end #end
  pigment { rgb <.86,.85,.82> } finish { diffuse 0.72 } }
