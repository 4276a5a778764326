// A molecule: balls joined by rods, and rings around them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.5, -8> look_at 0 angle 40 }
light_source { <-6, 8, -7>, rgb 0.8 }
light_source { <6, 3, -5>, rgb 0.25 }
background { rgb <0.1, 0.12, 0.18> }
#declare Shiny = finish { ambient 0.08 diffuse 0.65 specular 0.5 roughness 0.01 reflection 0.06 }
#macro Atom(I) <2.1*cos(I*pi/3), 0.35*mod(I, 2) - 0.2, 2.1*sin(I*pi/3)> #end
#for (I, 0, 5)
  #local Here = Atom(I);
  sphere { Here, 0.45 pigment { rgb <0.25, 0.25, 0.28> } finish { Shiny } }
  cylinder { Here, Atom(I + 1), 0.12 pigment { rgb <0.7, 0.68, 0.6> } finish { Shiny } }
  cylinder { Here, Here*1.5 + 0.3*y, 0.09 pigment { rgb <0.7, 0.68, 0.6> } finish { Shiny } }
  sphere { Here*1.5 + 0.3*y, 0.25 pigment { rgb <0.85, 0.85, 0.8> } finish { Shiny } }
  torus { 0.55, 0.035 rotate <90*mod(I, 2), 35*I, 25*I> translate Here pigment { rgb <0.8, 0.35, 0.15> } finish { Shiny } }
#end
torus { 2.1, 0.05 translate -0.6*y pigment { rgb <0.2, 0.4, 0.7> } finish { Shiny } }
