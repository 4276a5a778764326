// mistakes in lines 2, 3, 4: strings without double quotes
#include 'colors.inc'
#include <colors.inc>
sphere { 0, 1 pigment { image_map { png picture.png } } }
