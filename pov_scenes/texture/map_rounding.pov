// The share of the difference of two colours is rounded before it is added: the last bits of channels.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <8, 6, -5> direction z right 16*x up 12*y }
#declare Red = rgbft <0.137, 0.529, 0.911, 0.2, 0.7>;
#declare Blue = rgbft <0.853, 0.211, 0.347, 0.6, 0.1>;
#declare Colors = function { pigment { gradient x color_map { [0.13 Red] [0.87 Blue] } } }
#declare Pigments = function { pigment { gradient x pigment_map { [0.13 color Red] [0.87 color Blue] } } }
#macro Bit(Value) mod(floor(Value * pow(2, 25)), 2) #end
#for (Row, 0, 11)
  #for (Column, 0, 15)
    #local At = 0.14 + (16 * Row + Column) * 0.0037;
    #if (Row < 6) #local C = Colors(At, 0, 0); #else #local C = Pigments(At, 0, 0); #end
    box {
      <Column, Row, 0>, <Column + 1, Row + 1, 1>
      pigment { rgb <Bit(C.red), Bit(C.filter), Bit(C.transmit)> } finish { ambient 1 diffuse 0 }
    }
  #end
#end
