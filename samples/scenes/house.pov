// A house in a landscape: tiled roof, windows, chimney, fence, path, trees, clouds.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "functions.inc"

camera { location <-1.5, 2.6, -19> look_at <0.2, 3.5, 0> angle 48 right x*4/3 }
light_source { <-70, 60, -55>*10 rgb <1.0, 0.95, 0.84>*1.55 }
light_source { <50, 60, -40>*10 rgb <0.6, 0.75, 1.0>*0.22 shadowless }
#default { finish { ambient 0.07 diffuse 0.8 } }

sky_sphere {
  pigment { gradient y color_map { [0 rgb <.93,.93,.90>] [0.10 rgb <.66,.76,.86>] [0.32 rgb <.28,.42,.62>] [1 rgb <.14,.26,.46>] } }
  pigment { bozo turbulence 0.55 octaves 7 omega 0.5 lambda 2.2 scale <0.42, 0.19, 0.42> translate <0.15, 0.05, 0.3>
    color_map { [0.0 rgbt <1,1,1,0>] [0.40 rgbt <1,1,.98,0.0>] [0.52 rgbt <.74,.77,.83,0.30>] [0.62 rgbt <.8,.85,.9,1>] [1 rgbt 1] } }
}

// Ground, hills, path.
#declare Height = function(x, z) { 0.35*f_noise3d(x*0.22, 0, z*0.22) + 0.010*max(0, z)*max(0, z)*0.12 - 0.3 }
#declare PathX = function(z) { -0.6 + 0.9*sin(z*0.22 + 0.9) - 0.12*min(0, z+4) }
isosurface { function { y - Height(x, z) - 0.035*f_noise3d(x*8, 0, z*8)*select(abs(x - PathX(z)) - 0.75, 0.2, 1) }
  contained_by { box { <-60, -1, -20>, <60, 6, 40> } } max_gradient 1.7 accuracy 0.01
  pigment { function { min(1, max(0, (abs(x - PathX(z) + 0.35*(f_noise3d(x*3, 0, z*3)-0.5)) - 0.62)*5)) }
    pigment_map {
      [0 bozo scale 0.12 color_map { [0 rgb <.62,.54,.42>] [1 rgb <.76,.68,.55>] }]
      [1 bozo scale <0.4, 1, 0.25> turbulence 1 color_map { [0 rgb <.11,.18,.05>] [0.6 rgb <.18,.26,.08>] [1 rgb <.27,.33,.12>] }] } } }
#macro Hill(C, R, Col) sphere { 0, 1 scale R translate C pigment { bozo scale 0.10 turbulence 0.15 color_map { [0.2 rgb Col*0.7] [0.8 rgb Col*1.15] } } finish { ambient 0.2 } } #end
Hill(<-55, -2, 120>, <75, 19, 30>, <.20,.27,.26>)
Hill(<60, -2, 100>, <70, 15, 30>, <.16,.23,.19>)

// Grass blades near the camera.
#declare S = seed(3);
#for (I, 1, 5200)
  #local Z = -15 + 16*pow(rand(S), 1.4); #local X = -9 + 18*rand(S); #local H = 0.12 + 0.22*rand(S);
  #if (abs(X - PathX(Z)) > 0.75)
    #local B = <X, Height(X, Z), Z>;
    triangle { B - 0.02*x, B + 0.02*x, B + <0.2*rand(S)-0.1, H, 0> pigment { rgb <.16,.24,.06>*(0.6+1.1*rand(S)) } }
  #end
#end

// The house. Gable wall to the left front.
#declare Wall = texture { pigment { bozo scale 0.5 turbulence 0.6 color_map { [0 rgb <.82,.78,.69>] [1 rgb <.90,.87,.80>] } } normal { bumps 0.25 scale 0.05 } }
#declare Timber = texture { pigment { rgb <.12,.07,.045> } }
#macro Window(C, W, H)  // in the plane z = C.z, facing -z
  union {
    box { <-W,-H,-0.02>, <W,H,0.05> pigment { rgb <.02,.03,.045> } finish { specular 0.6 reflection 0.18 } }
    difference { box { <-W-.1,-H-.1,-0.07>, <W+.1,H+.1,0.03> } box { <-W,-H,-1>, <W,H,1> } pigment { rgb .92 } }
    box { <-.035,-H,-0.05>, <.035,H,0> pigment { rgb .92 } } box { <-W,-.035,-0.05>, <W,.035,0> pigment { rgb .92 } }
    box { <-W-.2,-H-.2,-0.18>, <W+.2,-H-.1,0> pigment { rgb .55 } }
    box { <-W-.62,-H-.05,-0.09>, <-W-.13,H+.05,0> } box { <W+.13,-H-.05,-0.09>, <W+.62,H+.05,0> }
    texture { pigment { gradient y scale 0.12 color_map { [0 rgb <.07,.14,.13>] [0.7 rgb <.13,.24,.22>] [0.71 rgb <.03,.06,.06>] [1 rgb <.03,.06,.06>] } } }
    translate C }
#end
#declare House = union {
  box { <-4,-0.5,-2.6>, <4,3.2,2.6> texture { Wall } }
  prism { linear_spline -3.98, 3.98, 4, <-2.6,3.2>, <2.6,3.2>, <0,6.1>, <-2.6,3.2> rotate <-90,0,0> rotate 90*y texture { Wall } }
  box { <-4.03,-0.5,-2.66>, <4.03,0.35,2.66> pigment { cells scale <.5,.25,.5> color_map { [0 rgb .22] [1 rgb .42] } } }
  // Roof: rows of tiles on both sides.
  #macro RoofSide() union {
      #for (R, 0, 16) #for (T, 0, 35)
        cylinder { <-4.45+T*0.255+mod(R,2)*0.09, 0.02, R*0.245>, <-4.45+T*0.255+mod(R,2)*0.09, 0.08, R*0.245-0.29>, 0.135
          pigment { rgb <.44,.17,.10>*(0.55+0.7*rand(S)) } }
      #end #end
      box { <-4.5,-0.1,-0.2>, <4.5,0.0,4.0> texture { Timber } } } #end
  object { RoofSide() rotate -48.1*x translate <0, 2.92, -2.98> }
  object { RoofSide() rotate -48.1*x translate <0, 2.92, -2.98> rotate 180*y }
  cylinder { <-4.5,6.02,0>, <4.5,6.02,0>, 0.2 pigment { rgb <.34,.13,.08> } }
  // Chimney.
  box { <1.9,4.9,-0.5>, <2.8,7.2,0.4> pigment { brick rgb .55, rgb <.40,.16,.10> scale 0.035 } }
  box { <1.8,7.2,-0.6>, <2.9,7.38,0.5> pigment { rgb .35 } }
  cylinder { <2.35,7.3,-.05>, <2.35,7.75,-.05>, 0.2 pigment { rgb <.35,.14,.08> } }
  // Front: door, windows. A dormer on the roof.
  Window(<-2.5,1.75,-2.62>, 0.5, 0.68) Window(<2.5,1.75,-2.62>, 0.5, 0.68)
  box { <-.55,-.2,-2.7>, <.55,2.25,-2.5> pigment { gradient x scale 0.22 color_map { [0 rgb <.30,.07,.05>] [.9 rgb <.36,.09,.06>] [.92 rgb .02] [1 rgb .02] } } }
  difference { box { <-.72,-.3,-2.78>, <.72,2.42,-2.5> } box { <-.55,-1,-3>, <.55,2.25,-2> } pigment { rgb .9 } }
  sphere { <.4,1,-2.74>, 0.06 pigment { rgb <.8,.65,.25> } }
  box { <-.95,-.6,-3.5>, <.95,0.0,-2.6> pigment { rgb .5 } }
  // Gable windows.
  object { Window(<0,1.75,0>, 0.5, 0.68) rotate 90*y translate <-4.02,0,0> }
  object { Window(<0,4.2,0>, 0.36, 0.45) rotate 90*y translate <-4.02,0,0> }
  #for (I, 0, 1) box { <-4.06, 3.15+I*1.9, -2.6+I*1.75>, <-3.9, 3.3+I*1.9, 2.6-I*1.75> texture { Timber } } #end
}
object { House rotate 24*y translate <1.4, 0.15, 1.5> }

// A tree: forked trunk and branches, then leaves round the twig ends.
#macro Branch(P, D, L, R, Depth, Leaves)
  #local Q = P + D*L;
  cone { P, R, Q, R*0.68 texture { Timber } }
  sphere { Q, R*0.68 texture { Timber } }
  #if (Depth > 0)
    #for (K, 1, 3)
      #local N = vnormalize(D + 0.75*<rand(S)*2-1, rand(S)*1.1-0.35, rand(S)*2-1>);
      Branch(Q, N, L*(0.66+0.2*rand(S)), R*0.62, Depth-1, Leaves)
    #end
  #else
    #for (K, 1, Leaves)
      #local C = Q + 0.62*<rand(S)*2-1, rand(S)*1.6-0.8, rand(S)*2-1>;
      #local A = 0.105*vnormalize(<rand(S)-.5, rand(S)-.5, rand(S)-.5>); #local B = 0.085*vnormalize(<rand(S)-.5, rand(S)-.5, rand(S)-.5>);
      triangle { C - A, C + A, C + B*2 pigment { rgb <.13,.21,.05>*(0.45+1.0*rand(S)) } }
    #end
  #end
#end
union { Branch(<0,-0.3,0>, <0.04,1,0>, 2.2, 0.34, 4, 120) translate <-7.4, 0, 2.5> }
union { Branch(<0,-0.3,0>, <-0.05,1,0>, 1.7, 0.26, 4, 100) translate <9.0, 0.3, 5> }
#for (I, 0, 9)  // firs behind
  #local X = -19 + I*4.4 + 2*rand(S); #local H = 3.8 + 2.4*rand(S);
  union { #for (K, 0, 6) cone { 0, 1.5*(1-K/7.6), 1.15*y, 0.05 scale <1, H/6, 1> translate y*(0.6+K*H/8) } #end
    pigment { rgb <.035,.065,.045> } normal { bumps 1.5 scale 0.12 } translate <X, 0.4, 17 + 4*rand(S)> }
#end
// Bushes at the wall.
#macro Bush(C, R) union { #for (I, 1, 900) #local D = vnormalize(<rand(S)-.5, rand(S)-.25, rand(S)-.5>)*R*(0.8+.25*rand(S)); #local A = 0.1*vnormalize(<rand(S)-.5,rand(S)-.5,rand(S)-.5>);
  triangle { D - A, D + A, D + 0.16*vnormalize(<rand(S)-.5,rand(S),rand(S)-.5>) pigment { rgb <.12,.20,.06>*(0.5+1.0*rand(S)) } } #end translate C } #end
Bush(<-1.9, 0.1, -1.6>, 0.8) Bush(<4.6, 0.1, -3.4>, 0.9) Bush(<5.8, 0.1, -3.3>, 0.7)

// Picket fence with a gap at the path.
#for (I, 0, 46)
  #local X = -9.4 + I*0.42; #local Z = -6.2 + 0.04*X;
  #if (abs(X - PathX(Z)) > 0.95)
    union { box { <-.09,-.3,-.03>, <.09,.95,.03> } prism { linear_spline -.03, .03, 4, <-.09,.95>, <.09,.95>, <0,1.12>, <-.09,.95> rotate -90*x }
      pigment { rgb .93 } rotate 3*(rand(S)-.5)*z translate <X, Height(X, Z)+0.05, Z> }
    box { <X-.22,.3,Z+.03>, <X+.22,.4,Z+.07> pigment { rgb .86 } translate Height(X, Z)*y }
    box { <X-.22,.72,Z+.03>, <X+.22,.82,Z+.07> pigment { rgb .86 } translate Height(X, Z)*y }
  #end
#end
