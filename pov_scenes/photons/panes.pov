// Photons meet opaque, faint and clear panes before their target, hidden walls behind it, and a slab that touches it.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.02 max_trace_level 6 autostop 0 } }
camera { location <0,7,-7> look_at <0,-1,0> angle 50 }
light_source { <0,9,0>, 1.2 photons { refraction on reflection on } }
#default { finish { ambient 0.1 diffuse 0.7 } }
plane { y, -2 pigment { rgb 1 } }
#declare Prism = prism { -0.8,0.8,4, <-1,-1>,<1,1>,<1,-1>,<-1,-1> rotate -90*x rotate 180*z translate <-0.8,1,0.8>
  pigment { rgbt <0.9,1,0.9,0.9> } interior { ior 1.5 } photons { target } }
object { Prism }
box { <0,-1,-1.6>, <2,0,1.6> pigment { rgbt <1,0.8,0.6,0.9> } finish { reflection 0.3 } interior { ior 1.2 }
  photons { target } rotate -10*z }
box { <0,-1.5,-1.6>, <2,-1,1.6> pigment { rgbt <0.7,0.8,1,0.9> } photons { target } rotate -10*z }
// Light ends at the first two panes and passes the others; four clear panes take too many levels.
box { <0.1,2,-1.4>, <0.5,2.05,-0.8> pigment { rgb 0.5 } photons { pass_through } }
box { <0.6,2,-1.4>, <1,2.05,-0.8> pigment { rgbt <1,1,1,0.05> } photons { pass_through } }
box { <1.1,2,-1.4>, <1.5,2.05,-0.8> pigment { rgbt <1,1,1,0.5> } photons { pass_through } }
box { <0.1,2,-0.6>, <0.5,2.05,0> pigment { rgb 0.5 } no_image }
#for (I, 0, 3) disc { <0.8,2+I*0.1,-0.3>, y, 0.25 pigment { rgbt 1 } photons { pass_through } } #end
disc { <1.4,2,-0.3>, y, 0.25 pigment { rgbt 1 } photons { pass_through } }
// Mirrored light meets what only cameras do not see.
box { <-2.6,-2,-1.6>, <-2.5,1,0.8> pigment { rgb <1,0.9,0.5> } no_reflection }
box { <-3.1,-2,-1.6>, <-3,1,3> pigment { rgb <0.5,0.9,1> } }
