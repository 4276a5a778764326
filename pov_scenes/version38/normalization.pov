// Vectors are divided by their lengths: the last bits of `vnormalize` and of what `trace` finds.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location <8, 6, -5> direction z right 16*x up 12*y }
#macro Bits(V) <mod(floor(abs(V.x) * pow(2, 53)), 8), mod(floor(abs(V.y) * pow(2, 53)), 8), mod(floor(abs(V.z) * pow(2, 53)), 8)> / 7 #end
#declare Shapes = array {
  sphere { <0.1, 0.2, -0.3>, 1.37 rotate <10, 20, 30> },
  cylinder { <-0.3, -1, 0.2>, <0.5, 1.1, -0.1>, 0.9 rotate <5, 15, 25> },
  cone { <-0.3, -1, 0.2>, 1.2, <0.5, 1.1, -0.1>, 0.4 translate <0.1, 0, 0.2> },
  disc { <0.1, 0.2, 0.1>, <1, 2, -3>, 1.6 rotate <5, 15, 25> },
  triangle { <-1.3, -1.1, 0.2>, <1.6, -0.7, -0.3>, <0.2, 1.9, 0.4> rotate <10, 20, 30> }
};
#declare Normal = <0, 0, 0>;
#for (Row, 0, 11)
  #for (Column, 0, 15)
    #local V = <Row - 5.3, Column - 7.2, 11.7>;
    #if (Row = 0) #local Shade = Bits(vnormalize(V)); #else
      #local Object = Shapes[mod(Row, 5)];
      #local Hit = trace(Object, <Row / 9, Column / 11, -4.7>, <Column / 50 - 0.2, -Row / 40, 4.9>, Normal);
      #if (Row > 5) #local Shade = Bits(Normal); #else #local Shade = Bits(Hit); #end
    #end
    box {
      <Column, Row, 0>, <Column + 1, Row + 1, 1>
      pigment { rgb Shade } finish { ambient 1 diffuse 0 }
    }
  #end
#end
