// Tops of boxes in one plane, in a scene with unbounded objects: these hang in a node of their own, the first child of
// the root of POV-Ray's tree, which changes the order of boxes that a ray enters at one distance.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { location <-8, 4, -14> angle 40 look_at <-2, 0, -4> }
light_source { 100, 1 }
#declare Random = seed(52);
#macro Integer(From, To) floor(From + rand(Random)*(To + 0.999 - From)) #end
#declare I = 0;
#while (I < 24)
  #local X = Integer(-9, 5);
  #local Z = Integer(-9, 5);
  #local Size = <Integer(3, 7), Integer(1, 2), Integer(3, 7)>;
  box {
    <X, -Size.y, Z>, <X + Size.x, 0, Z + Size.z>
    pigment { rgb <rand(Random), rand(Random), rand(Random)> }
  }
  #declare I = I + 1;
#end
plane { y, -50 pigment { rgb 1 } }
plane { y, -60 pigment { rgb 1 } }
// Clear glass before the boxes: rays that go on through it meet the same tree.
plane { z, -12 hollow pigment { rgbf <0.9, 1, 0.9, 1> } }
