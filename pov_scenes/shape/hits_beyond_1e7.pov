// Planes, spheres, discs and triangles end at a distance of 1e7, boxes do not; the jitter asks for POV-Ray's distances.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 22000, 0> look_at <0, 22000, 1> }
background { rgb <0.1, 0.2, 0.6> }
light_source { <-9e4, 3e5, -9e4>, rgb 1 area_light 9e3*x, 9e3*z, 2, 2 jitter }
plane { y, 0 pigment { rgb <0.2, 0.6, 0.1> } }
#declare Far = finish { ambient 1 diffuse 0 }
#macro Row(Height, Distance)
  sphere { <-5e6, Height, Distance>, 6e5 pigment { rgb x } finish { Far } }
  disc { <-3e6, Height, Distance>, z, 6e5 pigment { rgb x + y } finish { Far } }
  triangle { <-2e6, Height, Distance>, <-8e5, Height, Distance>, <-1.4e6, Height + 6e5, Distance> pigment { rgb 1 } finish { Far } }
  box { <2e5, Height, Distance>, <1.2e6, Height + 6e5, Distance + 1> pigment { rgb y + z } finish { Far } }
  torus { 5e5, 1e5 rotate 90*x translate <2.4e6, Height, Distance> pigment { rgb x + z } finish { Far } }
  superellipsoid { <0.5, 0.5> scale 5e5 translate <4e6, Height, Distance> pigment { rgb z } finish { Far } }
#end
Row(4e6, 7e6)
Row(3e6, 9.4e6)
Row(2e6, 1.2e7)
#declare Ground = plane { y, 0 }
#declare Block = box { -1, 1 }
#for (I, 0, 3)
  #declare Normal = 0*x;
  #declare Found = trace(Ground, <0, 4e6*(I + 1), 0>, -y, Normal);
  sphere { <-5e3 + 3e3*I, 1.95e4, 1.4e4>, 800 pigment { rgb vlength(Normal) } finish { Far } }
  #declare Normal = 0*x;
  #declare Found = trace(Block, <0, 4e6*(I + 1), 0>, -y, Normal);
  sphere { <-5e3 + 3e3*I, 1.7e4, 1.4e4>, 800 pigment { rgb vlength(Normal) } finish { Far } }
#end
