// Holes have the texture of what cuts them, and what is seen from the other side has the interior texture.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <1, 9, -13> look_at <0, 0.1, 0> right 4/3*x angle 36 }
light_source { <5, 18, -9> 1 }
#default { finish { ambient 0.4 diffuse 0.6 } }
#declare Slab = box { <-1.2, -0.5, -1.1>, <1.2, 0.4, 1.1> pigment { rgb 1 } }
#declare Cuts = array[12] {
  box { <-1, 0, -1>, 1 },
  cylinder { 0, y, 1 },
  sphere { 0.5*y, 0.9 },
  prism { 0, 1, 5, <1, 1>, <-1, 1>, <-1, -1>, <1, -1>, <1, 1> },
  lathe { 4 <0, 0>, <1, 0>, <1, 1>, <0, 1> },
  cone { 0, 0.5, y, 1 },
  text { ttf "cyrvetic.ttf" "O" 1, 0 rotate 90*x translate <-0.35, 0.8, -0.4> scale 2 },
  quadric { <1, 1, 1>, <0, -1, 0>, <0, 0, 0>, -0.5 },
  prism { conic_sweep 0.3, 1, 5, <1, 1>, <-1, 1>, <-1, -1>, <1, -1>, <1, 1> scale 1.2 translate -0.5*y },
  blob { threshold 0.5 sphere { 0.5*y, 1.5, 1 } },
  union { sphere { 0.3*y, 0.7 } torus { 0.8, 0.3 translate 0.3*y } },
  difference { sphere { 0.5*y, 0.9 } box { -1, <0, 2, 1> } }
}
#for (I, 0, 11)
  #declare Cut = object { Cuts[I] pigment { rgb <1, 0.3, 0.2> } interior_texture { pigment { rgb <0.2, 0.8, 0.4> } } }
  difference { object { Slab } object { Cut } rotate -20*x translate <3*mod(I, 4) - 4.5, 0, 3.2 - 3*int(I/4)> }
#end
object { Cut rotate 150*x translate <-6.5, 0, 0> }
object { Cuts[3] pigment { rgb <1, 0.3, 0.2> } interior_texture { pigment { rgb <0.2, 0.8, 0.4> } } rotate -110*x scale 0.7 translate <6.3, 0, -2> }
object { Cuts[6] pigment { rgb <1, 0.3, 0.2> } interior_texture { pigment { rgb <0.2, 0.8, 0.4> } } rotate -60*x scale 0.7 translate <6.3, 0, 1> }
